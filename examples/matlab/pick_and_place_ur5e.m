% A pick-and-place of the UR5e: takes a cube from the floor, turns it by 90
% degrees and puts it down on the other side.
%
% Writes pick_and_place_ur5e.mat with q (N x 7) and fs (Hz): columns 1 to 6 are
% the joints in rad, column 7 is the gripper, 0 open and 1 closed. Runs
% unchanged in MATLAB and in GNU Octave.

fs = 100;                        % frames per second
deg = pi / 180;
robot = ur5e();

grip = 0.166;                    % m, from tool0 to the tcp of the parallel gripper
cube = 0.05;                     % m, edge of the cube
low = cube / 2 + grip;           % m, height of tool0 when the fingers hold the cube
high = low + 0.10;               % m, height of approach
down = -0.25;                    % m/s, vertical speed at the height of approach
up = 0.25;

p = forward_kinematics(robot, robot.home);
radius = norm(p(1:2));
azimuth = atan2(p(2), p(1));

% radius azimuth height turn tilt of tool0 (see tool_path), and when it is there
points = [radius  azimuth  p(3)   0       0     % home
          0.52    -35*deg  high   0       0     % above the cube
          0.52    -35*deg  low    0       0     % at the cube
          0.52    -35*deg  low    0       0     % the fingers close
          0.52    -35*deg  high   0       0     % lifted
          0.46     60*deg  high   90*deg  0     % above the place
          0.46     60*deg  low    90*deg  0     % at the place
          0.46     60*deg  low    90*deg  0     % the fingers open
          0.46     60*deg  high   90*deg  0     % off
          radius  azimuth  p(3)   0       0];   % home
times = [0; 1.2; 1.8; 2.2; 2.8; 4.6; 5.2; 5.6; 6.2; 7.6];
height_speed = [0; down; 0; 0; up; down; 0; 0; up; 0];

velocities = zeros(size(points));
velocities(:, 3) = height_speed;
q = tool_path(robot, quintic_path(fs, times, points, velocities), 0);

t = (0:size(q, 1) - 1)' / fs;
gripper = double(t >= 1.85 & t < 5.25);
q = [q gripper];

check_motion(robot, q, fs);
save('pick_and_place_ur5e.mat', 'q', 'fs', '-v6');
