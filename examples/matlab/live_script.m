% A motion that is planned, checked and seen without leaving MATLAB or Octave.
%
% Run it again and again beside an open page of the lab: each run replaces what is shown.
% Before the first run: addpath matlab, then lab = mrlab.connect('http://127.0.0.1:8080')

fs = 100;                              % Hz
t = (0:1 / fs:4)';                     % s
from = [0, -90, 90, -90, -90, 0];      % deg
to = [60, -70, 100, -120, -90, 45];    % deg
s = 10 * (t / 4) .^ 3 - 15 * (t / 4) .^ 4 + 6 * (t / 4) .^ 5;
q = deg2rad(from + s * (to - from));   % rad, a row a frame and a column a joint

report = mrlab.check(q, fs, 'robot', 'ur5e')
if report.ok
    mrlab.show(q, fs, 'robot', 'ur5e');
end
