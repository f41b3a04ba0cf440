function report = check(varargin)
%CHECK Say what is wrong with a motion, and the line that mends it.
%   REPORT = mrlab.check(Q, FS) checks a motion as the lab would when it is published. Q has a row a
%   frame and a column a joint, rad (m for prismatic joints). FS is the rate, Hz, or a vector with
%   the time of each row, s. Without a semicolon the report is shown as a table: rows, joint, value,
%   limit, and the line that mends it.
%
%   mrlab.check(Q, FS, 'robot', 'ur5e') checks for that model; else for that of the lab's first robot.
%   mrlab.check(LAB, Q, FS, ...) asks that lab.
%   Further options are those of "mrlab convert": 'end_effector', 'gripper', 'units', 'degrees',
%   'unwrap', 'resample', 'columns', 'transpose', 'join', 'invert'.
%
%   REPORT.ok says whether the lab takes the motion, and REPORT.findings is a structure array with
%   the fields severity, code, rows, joint, value, limit, unit, message and mend. In MATLAB
%   struct2table(REPORT.findings) makes a table of it.
%
%   Nothing is published or shown. A motion that is wrong is no error here.
%
%   Example
%       fs = 100;  t = (0:1/fs:2)';
%       q = [t * 4, zeros(numel(t), 5)];        % the first joint goes too far
%       report = mrlab.check(q, fs, 'robot', 'ur5e')
%
%   See also mrlab.show, mrlab.connect.

[lab, motion] = mrlab.internal.arguments(varargin, {});
motion.name = inputname(motion.place);
report = mrlab.Report(mrlab.internal.send(lab, motion, false));
end
