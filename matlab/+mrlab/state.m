function robots = state(lab)
%STATE Return where the robots of the lab stand and what they play.
%   ROBOTS = mrlab.state(LAB) returns a structure array with a robot each: name, model,
%   end_effector, positions (a row, rad; m for prismatic joints), state (such as 'PLAYING'),
%   trajectory (such as 'anna/pick@3'), position and duration (s), rate. LAB may be left out.
%   Without an output it prints a table.
%
%   See also mrlab.play.

if nargin < 1
    lab = mrlab.internal.remembered();
end
found = mrlab.internal.request(lab, 'GET', '/api/robots');
all_of_them = mrlab.internal.each(found.robots);
for i = 1:numel(all_of_them)
    all_of_them(i).positions = reshape(all_of_them(i).positions, 1, []);
end
if nargout > 0
    robots = all_of_them;
    return
end
for robot = reshape(all_of_them, 1, [])
    mrlab.internal.say('%-14s %-14s %-10s %6.2f of %.2f s  %s\n', robot.name, robot.model, ...
        robot.state, robot.position, robot.duration, robot.trajectory);
end
end
