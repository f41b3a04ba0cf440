function found = each(value)
%EACH A list of JSON objects as a structure array: jsondecode has [] and cells for some of them.
if isempty(value)
    found = struct([]);
elseif iscell(value)
    found = [value{:}];
else
    found = value;
end
end
