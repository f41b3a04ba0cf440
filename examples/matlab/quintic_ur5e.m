% A joint-space motion of the UR5e: home, two poses, home again.
%
% Writes quintic_ur5e.mat with q (N x 6, rad) and fs (Hz). Runs unchanged in
% MATLAB and in GNU Octave.

fs = 100;                        % frames per second
deg = pi / 180;

% One row a pose, one column a joint: pan, lift, elbow, wrist 1, wrist 2, wrist 3
poses = [  0  -90   90  -90  -90    0      % home
          60 -120  120  -90  -60   45
         -50  -60   70  -40 -110  -60
           0  -90   90  -90  -90    0] * deg;
times = [0; 1.6; 4.2; 6.0];      % s, when it is there

q = quintic_path(fs, times, poses);

check_motion(ur5e(), q, fs);
save('quintic_ur5e.mat', 'q', 'fs', '-v7');
