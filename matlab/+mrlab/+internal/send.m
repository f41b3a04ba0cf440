function answer = send(lab, motion, shown, path)
%SEND Let the lab convert a motion, and show it on the page where SHOWN; PATH: a file instead.
%   The arrays go as a workspace file of the old uncompressed format: all 64 bits of each number.
options = motion.options;
options.shown = logical(shown);
if nargin > 3
    [~, name, ending] = fileparts(path);
    name = [name ending];
else
    path = [tempname() '.mat'];
    removed = onCleanup(@() delete(path));
    variable = motion.name;
    if isempty(variable) || any(strcmp(variable, {'t', 'fs'}))
        variable = 'q';
    end
    content.(variable) = motion.q;
    if numel(motion.rate) > 1
        content.t = motion.rate(:);
    elseif ~isempty(motion.rate)
        options.frame_rate = motion.rate;
    end
    if ~isfield(options, 'variable')
        options.variable = variable;
    end
    save(path, '-struct', 'content', '-v6');
    name = motion.source;
    if isempty(name)
        name = mrlab.internal.caller();
    end
    name = [name '.mat'];
end
address = ['/api/live/' mrlab.internal.escaped(name) '?' mrlab.internal.query(options)];
answer = mrlab.internal.request(lab, 'PUT', address, path);
answer.page = [lab.url '/live'];
end
