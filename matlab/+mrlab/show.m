function report = show(varargin)
%SHOW Show a motion on the page that is open.
%   mrlab.show(Q, FS) draws a motion in 3D and as plots on the lab's page, in place of the one
%   before: keep the page open beside MATLAB, and run your script again and again. What is shown is
%   a draft that only you see; mrlab.publish or mrlab.play give it to the lab.
%
%   mrlab.show(LAB, Q, FS, 'robot', 'ur5e', ...) takes the arguments of mrlab.check.
%   REPORT = mrlab.show(...) returns the report as mrlab.check does; REPORT.page is the page's address.
%
%   A motion that the lab refuses is drawn as well, with its findings, and is an error here whose
%   identifier tells the first finding: mrlab:jointLimit, mrlab:jump, mrlab:nonFinite.
%
%   Example
%       mrlab.show(q, 100)
%
%   See also mrlab.check, mrlab.live, mrlab.play.

[lab, motion] = mrlab.internal.arguments(varargin, {});
motion.name = inputname(motion.place);
shown = mrlab.Report(mrlab.internal.send(lab, motion, true));
raise(shown);
if nargout > 0
    report = shown;
else
    mrlab.internal.say('%s\nShown on %s\n', shown.message, shown.page);
end
end
