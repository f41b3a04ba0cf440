function text = identifier(code)
%IDENTIFIER The identifier of an error by its code: joint_limit becomes mrlab:jointLimit.
words = strsplit(code, '_');
for i = 2:numel(words)
    words{i} = [upper(words{i}(1:min(1, end))), words{i}(2:end)];
end
text = ['mrlab:' strjoin(words, '')];
end
