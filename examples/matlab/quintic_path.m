function path = quintic_path(fs, times, points, velocities)
% QUINTIC_PATH  Sample a smooth path through points at fs Hz.
%   times: K x 1 s, the first is 0; points: K x d; velocities: K x d per s,
%   all zero when left out (the path then rests at every point).
%   Between two points runs the quintic polynomial that has their positions and
%   velocities and no acceleration at either, so position, velocity and
%   acceleration have no jump anywhere. path: N x d, row i at (i - 1) / fs s.

if nargin < 4
    velocities = zeros(size(points));
end
t = (0:round(times(end) * fs))' / fs;
path = zeros(numel(t), size(points, 2));
for i = 1:numel(t)
    k = min(sum(times <= t(i) + 1e-9), numel(times) - 1);
    h = times(k + 1) - times(k);
    u = min(max((t(i) - times(k)) / h, 0), 1);
    D = points(k + 1, :) - points(k, :);
    a = h * velocities(k, :);
    b = h * velocities(k + 1, :);
    path(i, :) = points(k, :) + a * u + (10 * D - 6 * a - 4 * b) * u^3 ...
        + (-15 * D + 8 * a + 7 * b) * u^4 + (6 * D - 3 * a - 3 * b) * u^5;
end
end
