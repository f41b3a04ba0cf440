function text = query(options)
%QUERY Options as the query of an address, numbers with all their digits.
names = fieldnames(options);
parts = cell(1, numel(names));
for i = 1:numel(names)
    value = options.(names{i});
    if islogical(value)
        words = {'false', 'true'};
        value = words{value + 1};
    elseif isnumeric(value)
        value = sprintf('%.17g', value);
    end
    parts{i} = [names{i} '=' mrlab.internal.escaped(value)];
end
text = strjoin(parts, '&');
end
