% Stream joint positions from MATLAB to a robot of the lab. Needs the ROS Toolbox.
%
% Before MATLAB starts, set ROS_DOMAIN_ID as the lab has it (0 if it was not set). In Simulink do the
% same with a "Blank Message" of sensor_msgs/JointState, a "Bus Assignment" of its position, and a
% "Publish" block: leave name empty, and the values are in the robot's own order.

robot = 'ur5e_1';
amplitude = 0.3;   % rad
frequency = 0.25;  % Hz
rate = 50;         % messages a second
seconds = 10;

node = ros2node('/matlab');
states = ros2subscriber(node, ['/' robot '/joint_states'], 'sensor_msgs/JointState');
state = receive(states, 10);
commands = ros2publisher(node, ['/' robot '/joint_command'], 'sensor_msgs/JointState');
command = ros2message(commands);
command.name = state.name;

began = tic;
while toc(began) < seconds
    command.position = state.position + amplitude * sin(2 * pi * frequency * toc(began));
    send(commands, command);
    pause(1 / rate);
end
clear commands states node
