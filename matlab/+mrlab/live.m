function live(source, varargin)
%LIVE Show a motion again whenever a script, a function or a file changes.
%   mrlab.live(@myscript, FS) calls a function or a script and shows the motion, again each time its
%   file is saved. A function returns q, or q and fs; of a script the variables q and fs are
%   taken. mrlab.live('motion.mat') shows the variables q and fs of a file each time it is written.
%   mrlab.live(@() plan(3), FS, 'watch', 'plan.m') watches the file that you name.
%   Ctrl+C ends it.
%
%   Options, beside those of mrlab.check:
%     'play', 'ur5e_1'      play it on that robot, too, which blends to each new motion
%     'variable', 'q_des'   the name of the array; else q
%     'seconds', 60         end by itself
%
%   What is wrong with a motion is printed, and the next one is waited for. A .mat file may come
%   later; another file that is missing is mrlab:noFile.
%
%   Example
%       mrlab.live(@quintic, 100, 'robot', 'ur5e')
%
%   See also mrlab.show, mrlab.play.

fs = [];
if ~isempty(varargin) && isnumeric(varargin{1})
    fs = varargin{1};
    varargin(1) = [];
end
own = mrlab.internal.pairs(varargin);
given = struct('play', '', 'variable', 'q', 'seconds', Inf, 'watch', '');
for name = fieldnames(given)'
    if isfield(own, name{1})
        given.(name{1}) = own.(name{1});
        own = rmfield(own, name{1});
    end
end
watched = given.watch;
if isempty(watched)
    watched = file_of(source);
end
rest = [fieldnames(own), struct2cell(own)]';
begun = tic();
seen = [];
content = [];
there = exist(watched, 'file') ~= 0;
if ~there && (isa(source, 'function_handle') || isempty(regexp(watched, '\.mat$', 'once')))
    error('mrlab:noFile', 'There is no file %s.', watched);
end
later = {' as soon as it is written', ''};
mrlab.internal.say('Watching %s%s; Ctrl+C ends it.\n', watched, later{1 + there});
while toc(begun) < given.seconds
    found = dir(watched);
    if ~isempty(found) && is_new(watched, found(1), seen, content)
        seen = [found(1).datenum, found(1).bytes];
        content = bytes_of(watched);
        once(source, fs, given, rest, watched);
    end
    pause(0.1);
end
end

function yes = is_new(file, found, seen, content)
% A file's time has whole seconds in Octave: what was saved just now is compared by its bytes.
recent = abs(now() - found.datenum) * 86400 < 2;
yes = ~isequal(seen, [found.datenum, found.bytes]) || (recent && ~isequal(bytes_of(file), content));
end

function bytes = bytes_of(file)
id = fopen(file, 'r');
bytes = [];
if id >= 0
    bytes = fread(id, Inf, '*uint8');
    fclose(id);
end
end

function once(source, fs, given, rest, watched)
try
    [q, rate] = motion_of(source, fs, given.variable);
    [~, name] = fileparts(watched);
    named = [{'source', name}, reshape(rest, 1, [])];
    before = tic();
    if isempty(given.play)
        report = mrlab.show(q, rate, named{:});
        mrlab.internal.say('%s (%.2f s)\n', report.message, toc(before));
    else
        mrlab.show(q, rate, named{:});
        mrlab.play(given.play, q, rate, 'id', name, 'replace', true, named{:});
    end
catch problem
    mrlab.internal.say('%s\n', problem.message);
end
end

function [q, rate] = motion_of(source, fs, variable)
rate = fs;
if ischar(source) && ~isempty(regexp(source, '\.mat$', 'once'))
    [q, rate] = picked(load(source), variable, fs);
    return
end
if ischar(source)
    [~, name] = fileparts(source);
    source = str2func(name);
end
clear(strtok(regexprep(func2str(source), '^@(\([^)]*\))?\s*', ''), '(; '));
text = func2str(source);
if text(1) ~= '@' && is_script(text)
    [q, rate] = picked(run_script(text), variable, fs);
elseif isempty(fs)
    [q, rate] = source();
else
    q = source();
end
end

function [q, rate] = picked(found, variable, fs)
if ~isfield(found, variable)
    error('mrlab:noVariable', 'There is no variable %s; there are: %s.', variable, ...
        strjoin(fieldnames(found)', ', '));
end
q = found.(variable);
rate = fs;
if isempty(rate) && isfield(found, 'fs')
    rate = found.fs;
elseif isempty(rate) && isfield(found, 't')
    rate = found.t;
elseif isempty(rate)
    error('mrlab:noRate', 'Name the rate, as in mrlab.live(source, 100), or save fs or t.');
end
end

function found_ = run_script(name_)
% The variables of a script, in a workspace of its own.
eval(name_);
names_ = setdiff(who(), {'name_', 'found_', 'names_'});
found_ = struct();
for i_ = 1:numel(names_)
    found_.(names_{i_}) = eval(names_{i_});
end
end

function yes = is_script(name)
% Whether a file begins with a statement, and not with a function.
file = which(name);
yes = ~isempty(file) && isempty(regexp(regexprep(fileread(file), '(^|\n)\s*[%#][^\n]*', ''), ...
    '^\s*function\>', 'once'));
end

function file = file_of(source)
if ischar(source)
    file = source;
else
    file = which(strtok(regexprep(func2str(source), '^@(\([^)]*\))?\s*', ''), '(; '));
end
if isempty(file)
    error('mrlab:noFile', 'Name the file to watch: mrlab.live(source, fs, ''watch'', ''plan.m'').');
end
end
