function q = tool_path(robot, path, home_tilt)
% TOOL_PATH  Joints (N x d rad) that lead tool0 along a path, from home on.
%   path: N x 5, [radius (m), azimuth (rad), height (m), turn (rad), tilt (rad)]
%   in base_link. tilt 0: the tool points down, pi/2: outwards, level.
%   turn: about the vertical, 0 as at home. home_tilt: the tilt at home.

[~, R_home] = forward_kinematics(robot, robot.home);
down = rotation_y(home_tilt) * R_home;
q = zeros(size(path, 1), numel(robot.home));
now = robot.home;
for i = 1:size(path, 1)
    position = [path(i, 1) * cos(path(i, 2)); path(i, 1) * sin(path(i, 2)); path(i, 3)];
    R = rotation_z(path(i, 4)) * rotation_y(-path(i, 5)) * down;
    now = inverse_kinematics(robot, position, R, now);
    q(i, :) = now;
end
end

function R = rotation_y(a)
R = [cos(a) 0 sin(a); 0 1 0; -sin(a) 0 cos(a)];
end

function R = rotation_z(a)
R = [cos(a) -sin(a) 0; sin(a) cos(a) 0; 0 0 1];
end
