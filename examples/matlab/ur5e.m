function robot = ur5e()
% UR5E  Kinematics and limits of the Universal Robots UR5e.
%   Joint j turns about axis(j,:) in a frame that lies at xyz(j,:) m and
%   rpy(j,:) rad in the link before it; tool0 is fixed to the last link.
%   Source: UniversalRobots/Universal_Robots_ROS2_Description, ur_type ur5e
%   (nominal calibration; the base's half turn is part of joint 1).

robot.name = 'UR5e';
robot.xyz = [0 0 0.1625; 0 0 0; -0.425 0 0; -0.3922 0 0.1333; 0 -0.0997 0; 0 0.0996 0];
robot.rpy = [0 0 pi; pi/2 0 0; 0 0 0; 0 0 0; pi/2 0 0; pi/2 pi pi];
robot.axis = repmat([0 0 1], 6, 1);
robot.tool0 = eye(3);
robot.lower = [-360 -360 -180 -360 -360 -360] * pi/180;   % rad
robot.upper = [360 360 180 360 360 360] * pi/180;         % rad
robot.velocity = [180 180 180 180 180 180] * pi/180;      % rad/s
robot.home = [0 -90 90 -90 -90 0] * pi/180;               % rad
end
