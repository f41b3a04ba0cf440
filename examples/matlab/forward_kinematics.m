function [position, R, J] = forward_kinematics(robot, q)
% FORWARD_KINEMATICS  Where tool0 is when the joints stand at q (rad).
%   position: 3 x 1 m and R: 3 x 3, both in base_link.
%   J: 6 x d Jacobian, rows 1:3 m/rad, rows 4:6 rad/rad.

d = numel(q);
position = [0; 0; 0];
R = eye(3);
points = zeros(3, d);
joint_axes = zeros(3, d);
for j = 1:d
    position = position + R * robot.xyz(j, :)';
    if any(robot.rpy(j, :))
        R = R * rotation_rpy(robot.rpy(j, :));
    end
    points(:, j) = position;
    joint_axes(:, j) = R * robot.axis(j, :)';
    R = R * rotation_about(robot.axis(j, :), q(j));
end
R = R * robot.tool0;
J = zeros(6, d);
for j = 1:d
    J(:, j) = [skew(joint_axes(:, j)) * (position - points(:, j)); joint_axes(:, j)];
end
end

function R = rotation_rpy(rpy)
% Fixed-axis roll, pitch, yaw, as URDF means it.
R = rotation_about([0 0 1], rpy(3)) * rotation_about([0 1 0], rpy(2)) ...
    * rotation_about([1 0 0], rpy(1));
end

function R = rotation_about(axis, angle)
% Rodrigues' formula for a unit axis.
K = skew(axis);
R = eye(3) + sin(angle) * K + (1 - cos(angle)) * K * K;
end

function K = skew(v)
% K * w is the cross product of v and w.
K = [0 -v(3) v(2); v(3) 0 -v(1); -v(2) v(1) 0];
end
