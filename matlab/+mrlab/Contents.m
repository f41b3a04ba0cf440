% MR-Lab toolbox: from an array to a robot that moves, without leaving MATLAB or Octave.
%
% Begin with
%   lab = mrlab.connect('http://127.0.0.1:8080');   % shows a code; confirm it on the page
%   report = mrlab.check(q, fs)                     % which rows are wrong, and what mends them
%   mrlab.show(q, fs)                               % the motion on the page that is open
%
% q has a row a frame and a column a joint, rad (m for prismatic joints); a further column is
% the gripper. fs is the rate in Hz, or a vector with the time of each row in s.
%
% Functions
%   connect - Sign in at a lab, once.
%   check   - Say what is wrong with a motion, and the line that mends it.
%   show    - Show a motion on the page that is open.
%   play    - Play a motion on a robot of the lab.
%   stop    - End the run of a robot, after a collision too.
%   publish - Put a motion into the lab's catalogue.
%   state   - Return where the robots stand and what they play.
%   compare - Compare two motions, such as planned and measured.
%   fromBag - Read a motion from a ROS bag or any file that the lab reads.
%   live    - Show a motion again whenever a script, a function or a file changes.
%   help    - Show this text; Octave has it under mrlab.help.
%
% A motion is checked for the model of the lab's first robot, or for the one that you name, as in
% mrlab.check(q, fs, 'robot', 'ur5e').
%
% Errors have identifiers that programs can catch: mrlab:jointLimit, mrlab:noLab, and so on, one
% for each code of the lab.
%
% See also mrlab.connect, mrlab.check, mrlab.show.
