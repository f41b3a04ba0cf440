function stopped = stop(varargin)
%STOP End the run of a robot; after a collision take it back to its first frame.
%   mrlab.stop(LAB, 'ur5e_1') ends what the robot plays. A robot that a collision halted goes back
%   to the first frame of its motion, and may play again once its arm is clear there. LAB may be
%   left out.
%
%   STATE = mrlab.stop(...) returns the robot's state then, such as 'READY'.
%
%   Errors: mrlab:noRobotInScene; mrlab:roleTooLow where your role may not stop a robot.
%
%   See also mrlab.play, mrlab.state.

if nargin > 0 && isstruct(varargin{1})
    lab = varargin{1};
    varargin(1) = [];
else
    lab = mrlab.internal.remembered();
end
if numel(varargin) ~= 1 || ~ischar(varargin{1})
    error('mrlab:badArguments', 'Name the robot: mrlab.stop(''ur5e_1'').');
end
name = varargin{1};
found = mrlab.internal.request(lab, 'POST', ...
    ['/api/robots/' mrlab.internal.escaped(name) '/stop']);
if nargout > 0
    stopped = found.state;
elseif strcmp(found.state, 'COLLISION_HALT')
    mrlab.internal.say(['%s is still in its collision halt: %s.\nMove it, or what it touches, ' ...
        'on the page %s/lab.\n'], found.robot, found.message, lab.url);
else
    mrlab.internal.say('%s is stopped.\n', found.robot);
end
end
