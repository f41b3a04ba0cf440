function help()
%HELP Show what the toolbox offers.
%   mrlab.help prints the overview that MATLAB shows for "help mrlab".
%
%   See also mrlab.connect, mrlab.check, mrlab.show.

text = fileread(fullfile(fileparts(mfilename('fullpath')), 'Contents.m'));
fprintf('%s\n', regexprep(text, '(^|\n)%', '$1'));
end
