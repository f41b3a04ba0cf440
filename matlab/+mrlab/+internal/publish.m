function trajectory = publish(lab, motion, shown)
%PUBLISH Convert a motion and put it into the catalogue; throws the first finding of a refused one.
[published, motion] = mrlab.internal.take(motion, {'id', 'shared'});
if isempty(motion.source)
    motion.source = mrlab.internal.caller();
end
if ~isfield(published, 'id')
    published.id = regexprep(motion.source, '_line_\d+$', '');
end
report = mrlab.Report(mrlab.internal.send(lab, motion, shown));
raise(report);
published.draft = report.draft;
trajectory = mrlab.internal.request(lab, 'POST', '/api/trajectories', published);
end
