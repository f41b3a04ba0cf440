function q = inverse_kinematics(robot, position, R, q)
% INVERSE_KINEMATICS  Joints (rad) that bring tool0 to position (3 x 1 m) and R.
%   Starts at q and takes the solution nearest to it: damped least squares,
%   where the damping fades with the error, so that it ends as Newton does.

for step = 1:200
    [p, now, J] = forward_kinematics(robot, q);
    D = R * now';
    turn = [D(3, 2) - D(2, 3); D(1, 3) - D(3, 1); D(2, 1) - D(1, 2)] / 2;
    e = [position - p; turn];
    if norm(e) < 1e-11
        return
    end
    q = q + (J' * ((J * J' + (1e-12 + 1e-2 * (e' * e)) * eye(6)) \ e))';
end
error('%s does not reach [%.3f %.3f %.3f] m from here; choose a nearer point', ...
    robot.name, position);
end
