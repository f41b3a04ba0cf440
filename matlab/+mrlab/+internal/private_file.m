function private_file(path, text)
%PRIVATE_FILE Write a file that nobody else may read: it holds a token.
if mrlab.internal.octave()
    before = umask(77);
    restored = onCleanup(@() umask(before));
end
if exist(path, 'file')
    delete(path);
end
[file, why] = fopen(path, 'w');
if file < 0
    error('mrlab:noFile', 'Cannot write %s: %s', path, why);
end
fwrite(file, unicode2native(text, 'UTF-8'));
fclose(file);
if ~mrlab.internal.octave() && isunix()
    fileattrib(path, '-r -w', 'g o');
end
end
