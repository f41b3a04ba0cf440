function say(varargin)
%SAY Print at once, in Octave too.
fprintf(varargin{:});
if mrlab.internal.octave()
    fflush(stdout);
end
end
