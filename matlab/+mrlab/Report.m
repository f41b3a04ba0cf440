classdef Report
    %REPORT What the lab found in a motion; mrlab.check returns it.
    %   ok        whether the lab takes the motion
    %   message   the outcome in one sentence
    %   findings  structure array with severity ('error', 'warning', 'info'), code, rows ([first
    %             last], 0: the whole), joint, value, limit, unit, message, mend
    %   robot     the model it was checked for
    %   source    file and variable by which the lab knows the motion
    %   draft     names the motion at the lab
    %   page      address of the page that shows it
    %
    %   See also mrlab.check, mrlab.show.

    properties (SetAccess = private)
        ok = false
        message = ''
        findings = struct([])
        robot = ''
        source = ''
        draft = ''
        page = ''
    end

    methods
        function obj = Report(answer)
            % A report of the gateway's answer, as mrlab.internal.send returns it.
            found = answer.conversion;
            obj.ok = strcmp(found.outcome, 'accepted');
            obj.message = found.message;
            obj.robot = answer.options.robot_model;
            obj.source = answer.upload.file_name;
            if ~isempty(found.draft)
                obj.draft = found.draft;
            end
            obj.page = answer.page;
            rows = mrlab.internal.each(found.diagnostics);
            obj.findings = struct('severity', {}, 'code', {}, 'rows', {}, 'joint', {}, ...
                'value', {}, 'limit', {}, 'unit', {}, 'message', {}, 'mend', {});
            for i = 1:numel(rows)
                one = rows(i);
                obj.findings(end + 1) = struct('severity', one.severity, 'code', one.code, ...
                    'rows', [one.first_row, max(one.first_row, one.last_row)], ...
                    'joint', one.joint, 'value', one.value, 'limit', one.limit, ...
                    'unit', one.unit, 'message', one.message, 'mend', mending(one));
            end
        end

        function raise(obj)
            % Throw the first finding that refuses the motion as an error; give the doubts of one
            % that is taken as warnings.
            if obj.ok
                doubts = obj.findings(strcmp({obj.findings.severity}, 'warning'));
                before = warning('off', 'backtrace');
                restored = onCleanup(@() warning(before));
                for i = 1:numel(doubts)
                    warning(mrlab.internal.identifier(doubts(i).code), '%s', mended(doubts(i)));
                end
                return
            end
            found = obj.findings(strcmp({obj.findings.severity}, 'error'));
            if isempty(found)
                found = obj.findings;
            end
            if isempty(found)
                error('mrlab:refused', '%s', obj.message);
            end
            text = mended(found(1));
            if numel(found) > 1
                text = sprintf('%s\n  %d findings; mrlab.check lists them', text, numel(found));
            end
            error(mrlab.internal.identifier(found(1).code), '%s', text);
        end

        function disp(obj)
            % Print the findings, one below the other.
            outcome = obj.message;
            if ~obj.ok
                outcome = 'The lab refuses this motion.';
            end
            fprintf('  %s (%s, %s)\n', outcome, obj.robot, obj.source);
            if ~isempty(obj.findings)
                fprintf('\n  %-8s %-12s %-16s %12s %12s\n', '', 'rows', 'joint', 'value', 'limit');
            end
            for i = 1:numel(obj.findings)
                one = obj.findings(i);
                fprintf('  %-8s %-12s %-16s %12s %12s\n', one.severity, between(one.rows), ...
                    one.joint, quantity(one.value, one.unit), quantity(one.limit, one.unit));
                fprintf('    %s\n', one.message);
                if ~isempty(one.mend)
                    fprintf('    mend: %s\n', one.mend);
                end
            end
        end
    end
end

function text = mended(one)
% What is wrong, and the line that mends it.
text = one.message;
if ~isempty(one.mend)
    text = sprintf('%s\n  mend: %s', text, one.mend);
end
end

function text = mending(one)
% The first remedy in MATLAB's words; where there is none, the remedy's sentence.
text = one.remedy;
fixes = mrlab.internal.each(one.fixes);
for i = 1:numel(fixes)
    if ~isempty(fixes(i).matlab)
        % the array goes as it is, so nothing has to be saved
        text = regexprep(fixes(i).matlab, ';?\s*save\([^)]*\);?$', ';');
        return
    end
end
end

function text = between(rows)
if rows(1) == 0
    text = '';
elseif rows(1) == rows(2)
    text = sprintf('%d', rows(1));
else
    text = sprintf('%d-%d', rows(1), rows(2));
end
end

function text = quantity(value, unit)
if isempty(value)
    text = '';
else
    text = strtrim(sprintf('%.4g %s', value, unit));
end
end
