function check_motion(robot, q, fs)
% CHECK_MOTION  Stop with an error when q (N x d rad at fs Hz) asks too much.

speed = max(abs(diff(q(:, 1:numel(robot.home)))), [], 1) * fs;
for j = 1:numel(robot.home)
    if min(q(:, j)) < robot.lower(j) || max(q(:, j)) > robot.upper(j)
        error('joint %d of the %s goes from %.1f to %.1f deg; it can go from %.0f to %.0f', ...
            j, robot.name, min(q(:, j)) * 180/pi, max(q(:, j)) * 180/pi, ...
            robot.lower(j) * 180/pi, robot.upper(j) * 180/pi);
    end
    if speed(j) > robot.velocity(j)
        error('joint %d of the %s runs at %.0f deg/s; it can do %.0f; take more time', ...
            j, robot.name, speed(j) * 180/pi, robot.velocity(j) * 180/pi);
    end
end
fprintf('%s: %d frames, %.2f s, fastest joint at %.0f %% of its limit\n', robot.name, ...
    size(q, 1), (size(q, 1) - 1) / fs, 100 * max(speed ./ robot.velocity));
end
