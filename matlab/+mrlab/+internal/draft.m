function publishing = draft(lab, motion, shown)
%DRAFT Convert a motion; return the request that publishes it, throw the first finding of a refusal.
[publishing, motion] = mrlab.internal.take(motion, {'id', 'shared'});
if isempty(motion.source)
    motion.source = mrlab.internal.caller();
end
if ~isfield(publishing, 'id')
    publishing.id = regexprep(motion.source, '_line_\d+$', '');
end
report = mrlab.Report(mrlab.internal.send(lab, motion, shown));
raise(report);
publishing.draft = report.draft;
end
