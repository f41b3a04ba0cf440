function [lab, motion] = arguments(given, more, robot)
%ARGUMENTS The lab and the motion of a call: [LAB,] [ROBOT,] Q, FS, NAME, VALUE, ...
%   MORE: names of options beside those of the conversion. ROBOT: given where a robot comes first.
%   motion: q, rate (Hz, or s of each row; [] where not given), options, place (the number of the
%   argument that is q), robot (empty where none is asked for), model (that was named, or empty),
%   source ('' : the caller's line).
motion = struct('q', [], 'rate', [], 'place', 1, 'robot', '', 'model', '', 'name', '', 'source', '');
if ~isempty(given) && isstruct(given{1}) && isfield(given{1}, 'url')
    lab = given{1};
    given(1) = [];
    motion.place = 2;
else
    lab = mrlab.internal.remembered();
end
if nargin > 2
    if isempty(given) || ~ischar(given{1})
        error('mrlab:badArguments', 'Name the robot: mrlab.play(lab, ''ur5e_1'', q, fs).');
    end
    motion.robot = given{1};
    given(1) = [];
    motion.place = motion.place + 1;
end
if isempty(given)
    error('mrlab:badArguments', 'Give the motion: q, with a row a frame, and fs.');
end
motion.q = given{1};
given(1) = [];
if isnumeric(motion.q)
    if ~isreal(motion.q) || ndims(motion.q) ~= 2
        error('mrlab:badArguments', 'q is real, with a row a frame and a column a joint.');
    end
    motion.q = full(double(motion.q));
elseif ~ischar(motion.q)
    error('mrlab:badArguments', 'q is an array of numbers, not a %s.', class(motion.q));
end
if ~isempty(given) && isnumeric(given{1})
    motion.rate = double(given{1});
    given(1) = [];
    check_rate(motion);
end
motion.options = mrlab.internal.pairs(given, [conversion_options(), more]);
if ~isempty(motion.rate) && isfield(motion.options, 'frame_rate')
    error('mrlab:badArguments', 'Give the rate once: fs, or the option frame_rate.');
end
[own, motion] = mrlab.internal.take(motion, {'source', 'robot'});
if isfield(own, 'source')
    motion.source = own.source;
end
if isfield(own, 'robot')
    motion.model = own.robot;
    motion.options.robot_model = own.robot;
elseif isempty(lab.robot) && ~isfield(motion.options, 'robot_model') && isempty(motion.robot)
    error('mrlab:noModel', 'Name the model: ''robot'', ''ur5e''.');
elseif ~isfield(motion.options, 'robot_model')
    motion.options.robot_model = lab.robot;
end
end

function names = conversion_options()
% Options of "mrlab convert", as the lab takes them, and those of this side.
names = {'robot', 'source', 'robot_model', 'end_effector', 'frame_rate', 'variable', 'columns', ...
    'transpose', 'degrees', 'unwrap', 'resample', 'join', 'gripper', 'invert', 'units'};
end

function check_rate(motion)
rate = motion.rate;
if ~isreal(rate) || ~all(isfinite(rate(:)))
    error('mrlab:badRate', 'fs is a rate in Hz, or the time of each row in s, all finite.');
elseif numel(rate) == 1 && rate <= 0
    error('mrlab:badRate', 'fs is %g Hz; expected a rate above 0.', rate);
elseif isnumeric(motion.q) && numel(rate) ~= 1 && numel(rate) ~= size(motion.q, 1)
    error('mrlab:badRate', 'There are %d times for %d rows of q.', numel(rate), size(motion.q, 1));
end
end
