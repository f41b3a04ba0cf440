function text = escaped(text)
%ESCAPED A text as a part of an address: every byte but letters, digits and -_. as %XX.
bytes = unicode2native(char(text), 'UTF-8');
parts = cell(1, numel(bytes));
for i = 1:numel(bytes)
    if any(bytes(i) == uint8('ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.'))
        parts{i} = char(bytes(i));
    else
        parts{i} = sprintf('%%%02X', bytes(i));
    end
end
text = ['' parts{:}];
end
