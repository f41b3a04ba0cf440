function trajectory = publish(varargin)
%PUBLISH Put a motion into the lab's catalogue.
%   TRAJECTORY = mrlab.publish(Q, FS, 'id', 'pick') publishes a motion under that name, as its next
%   version. Without 'id' the name is that of the script that calls. With 'shared', true everybody
%   sees it. Further arguments are those of mrlab.check.
%
%   TRAJECTORY has id, version, frame_rate, frame_count, duration, and more.
%
%   Errors: the first finding's, such as mrlab:jointLimit, where the lab refuses the motion. Other
%   findings are warnings.
%
%   See also mrlab.play, mrlab.check.

[lab, motion] = mrlab.internal.arguments(varargin, {'id', 'shared'});
motion.name = inputname(motion.place);
made = mrlab.internal.request(lab, 'POST', '/api/trajectories', ...
    mrlab.internal.draft(lab, motion, false));
if nargout > 0
    trajectory = made;
else
    mrlab.internal.say('Published as %s, version %d.\n', made.id, made.version);
end
end
