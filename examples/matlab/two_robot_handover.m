% A hand-over: the UR5e picks up an upright rod and offers it, the KUKA
% KR 6 R900 sixx takes it from its hand and stands it up on its own side.
%
% The bases stand 1.2 m apart and face each other: UR5e at (0, 0) looking along
% +x, KUKA at (1.2, 0) turned by 180 degrees. Both motions begin together.
%
% Writes two_robot_handover_ur5e.mat and two_robot_handover_kr6.mat, each with q
% (N x 7, columns 1 to 6 in rad, column 7 the gripper) and fs (Hz). Runs
% unchanged in MATLAB and in GNU Octave.

fs = 100;                        % frames per second
deg = pi / 180;
level = 90 * deg;                % tilt of a tool that points outwards

between_bases = 1.2;             % m
grip = 0.166;                    % m, from tool0 to the tcp of the parallel gripper
rod = 0.16;                      % m, length of the rod
held = 0.04;                     % m, from the rod's end to the middle of the fingertips
low = rod - held + grip;         % m, height of tool0 when the rod stands on the floor
high = low + 0.10;               % m, height of approach
speed = 0.25;                    % m/s, vertical, at the height of approach

% The hand-over: both tools level on one line, each at its end of the rod.
height = 0.70;                                   % m
offer = 0.38;                                    % m, UR5e's tool0 from its base
take = between_bases - offer - 2*grip - (rod - 2*held);   % m, KUKA's from its own
ready = take - 0.10;                             % m, where the KUKA waits

% radius azimuth height turn tilt of each tool0 (see tool_path)
first = ur5e();
p = forward_kinematics(first, first.home);
home = [norm(p(1:2)) atan2(p(2), p(1)) p(3) 0 0];
points = [home                                 % home
          0.50   -45*deg  high    0  0         % above the rod
          0.50   -45*deg  low     0  0         % at the rod
          0.50   -45*deg  low     0  0         % the fingers close
          0.50   -45*deg  high    0  0         % lifted
          offer    0      height  0  level     % offered
          offer    0      height  0  level     % the KUKA takes it, the fingers open
          offer-0.10  0   height  0  level     % drawn back
          home
          home];
times = [0; 1.0; 1.5; 2.0; 2.45; 4.0; 4.75; 5.35; 7.0; 8.0];
velocities = zeros(size(points));
velocities(2, 3) = -speed;
velocities(5, 3) = speed;
q_ur5e = tool_path(first, quintic_path(fs, times, points, velocities), 0);

second = kr6_r900_sixx();
p = forward_kinematics(second, second.home);
home = [p(1) 0 p(3) 0 level];
points = [home                                 % home
          ready    0      height  0       level     % ready to take
          ready    0      height  0       level
          take     0      height  0       level     % at the rod
          take     0      height  0       level     % the fingers close, the UR5e leaves
          ready    0      height  0       level     % drawn back
          0.50    40*deg  high    40*deg  0         % above the place
          0.50    40*deg  low     40*deg  0         % at the place
          0.50    40*deg  low     40*deg  0         % the fingers open
          0.50    40*deg  high    40*deg  0         % off
          home];
times = [0; 2.0; 3.4; 4.1; 4.75; 5.25; 6.2; 6.6; 6.8; 7.1; 8.0];
velocities = zeros(size(points));
velocities(7, 3) = -speed;
velocities(10, 3) = speed;
q_kr6 = tool_path(second, quintic_path(fs, times, points, velocities), level);

% Column 7: the UR5e lets go only after the KUKA has closed its fingers.
t = (0:size(q_ur5e, 1) - 1)' / fs;
q_ur5e = [q_ur5e double(t >= 1.55 & t < 4.65)];
q_kr6 = [q_kr6 double(t >= 4.15 & t < 6.65)];

check_motion(first, q_ur5e, fs);
check_motion(second, q_kr6, fs);

q = q_ur5e;
save('two_robot_handover_ur5e.mat', 'q', 'fs', '-v7');
q = q_kr6;
save('two_robot_handover_kr6.mat', 'q', 'fs', '-v7');
