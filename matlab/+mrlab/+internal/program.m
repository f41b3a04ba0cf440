function name = program()
%PROGRAM The name by which a lab lists this program among a person's devices.
name = 'MATLAB';
if mrlab.internal.octave()
    name = 'Octave';
end
end
