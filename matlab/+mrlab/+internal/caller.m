function name = caller()
%CALLER The script that called the toolbox and its line, as the name of a file: pick_line_12.
name = 'command_window';
stack = dbstack('-completenames');
for i = 1:numel(stack)
    if isempty(strfind(stack(i).file, [filesep '+mrlab' filesep]))
        [~, script] = fileparts(stack(i).file);
        if ~isempty(script)
            name = sprintf('%s_line_%d', script, stack(i).line);
        end
        return
    end
end
end
