function robot = kr6_r900_sixx()
% KR6_R900_SIXX  Kinematics and limits of the KUKA KR 6 R900 sixx.
%   Joint j turns about axis(j,:) in a frame that lies at xyz(j,:) m and
%   rpy(j,:) rad in the link before it; tool0 is fixed to the last link.
%   Source: kroshu/kuka_robot_descriptions, kuka_agilus_support.

robot.name = 'KR 6 R900 sixx';
robot.xyz = [0 0 0.4; 0.025 0 0; 0.455 0 0; 0 0 0.035; 0.42 0 0; 0.08 0 0];
robot.rpy = zeros(6, 3);
robot.axis = [0 0 -1; 0 1 0; 0 1 0; -1 0 0; 0 1 0; -1 0 0];
robot.tool0 = [0 0 1; 0 1 0; -1 0 0];
robot.lower = [-170 -190 -120 -185 -120 -350] * pi/180;   % rad
robot.upper = [170 45 156 185 120 350] * pi/180;          % rad
robot.velocity = [360 300 360 381 388 615] * pi/180;      % rad/s
robot.home = [0 -90 90 0 0 0] * pi/180;                   % rad
end
