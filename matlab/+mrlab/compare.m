function result = compare(q1, q2, fs)
%COMPARE Compare two motions, such as planned and measured.
%   RESULT = mrlab.compare(Q1, Q2, FS) compares two arrays with a row a frame and a column a joint,
%   both at FS Hz; without FS the delay is in rows. Q2 may be longer or shorter, and late: the delay
%   is the one, in whole rows up to two seconds (200 rows), that makes the error least, and the
%   errors are what remains after it. Nothing is sent.
%
%   RESULT has delay (s; positive: Q2 is late) and, a column a joint, rms, most, and row, where
%   the error is the greatest (a row of Q1); in the unit of Q1. Without an output it prints a table.
%
%   Example
%       planned = q;  [measured, fs] = mrlab.fromBag('run_1');
%       mrlab.compare(planned, measured, fs)
%
%   Errors: mrlab:columnsDiffer where the motions do not have equally many columns.
%
%   See also mrlab.fromBag.

if nargin < 3
    fs = 1;
    reach = 200;
else
    reach = round(2 * fs);
end
columns = size(q1, 2);
if columns ~= size(q2, 2)
    error('mrlab:columnsDiffer', ...
        'Both motions have a column a joint; they have %d and %d. Take the same columns of each.', ...
        columns, size(q2, 2));
end
if columns == 0 || size(q1, 1) < 2 || size(q2, 1) < 2
    error('mrlab:noMotion', 'Each motion needs two rows and a column; they are %s and %s.', ...
        mat2str(size(q1)), mat2str(size(q2)));
end
best = Inf;
shift = 0;
reach = min([reach, size(q1, 1) - 2, size(q2, 1) - 2]);
for k = -reach:reach
    rows = max(1, 1 - k):min(size(q1, 1), size(q2, 1) - k);
    if numel(rows) < min(size(q1, 1), size(q2, 1)) / 2
        continue
    end
    apart = q2(rows + k, 1:columns) - q1(rows, 1:columns);
    score = mean(apart(:) .^ 2);
    if score < best - eps || (score <= best + eps && abs(k) < abs(shift))
        best = min(best, score);
        shift = k;
        found = apart;
        first = rows(1);
    end
end
compared = struct('delay', shift / fs, 'rms', sqrt(mean(found .^ 2, 1)));
[compared.most, place] = max(abs(found), [], 1);
compared.row = place + first - 1;
if nargout > 0
    result = compared;
    return
end
mrlab.internal.say('The second is %.3g later.\n%5s %12s %12s %8s\n', compared.delay, ...
    'joint', 'rms', 'most', 'in row');
for j = 1:columns
    mrlab.internal.say('%5d %12.4g %12.4g %8d\n', j, compared.rms(j), compared.most(j), ...
        compared.row(j));
end
end
