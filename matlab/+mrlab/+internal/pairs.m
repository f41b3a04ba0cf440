function options = pairs(given, known)
%PAIRS Names and values as a structure; KNOWN: the names that there are, none: any.
options = struct();
if mod(numel(given), 2) ~= 0
    error('mrlab:badArguments', 'Options come in pairs of a name and a value.');
end
for i = 1:2:numel(given)
    name = given{i};
    if ~ischar(name) || ~isvarname(name)
        error('mrlab:badArguments', 'Expected the name of an option, such as ''robot''.');
    end
    if nargin > 1 && ~any(strcmp(name, known))
        error('mrlab:badArguments', 'There is no option %s. There are: %s.', name, ...
            strjoin(known, ', '));
    end
    options.(name) = given{i + 1};
end
end
