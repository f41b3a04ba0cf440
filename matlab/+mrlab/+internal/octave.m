function yes = octave()
%OCTAVE Whether this is GNU Octave.
yes = exist('OCTAVE_VERSION', 'builtin') ~= 0;
end
