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
%   Errors: mrlab:columnsDiffer where the motions do not have equally many columns, mrlab:noMotion
%   where one is none, mrlab:nonFinite where a row has NaN or Inf, mrlab:badRate.
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
if ~(isnumeric(fs) && isscalar(fs) && isreal(fs) && isfinite(fs) && fs > 0)
    error('mrlab:badRate', 'FS is no number of rows a second; expected one number above 0.');
end
motions = {q1, q2};
for k = 1:2
    [row, column] = find(~isfinite(motions{k}), 1);
    if ~isempty(row)
        error('mrlab:nonFinite', ...
            'Row %d of motion %d has %g in column %d. Take rows without it, such as q(%d:end, :).', ...
            row, k, motions{k}(row, column), column, row + 1);
    end
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
unit = 's';
if nargin < 3
    unit = 'rows';
end
mrlab.internal.say('The second is %.3g %s later.\n%5s %12s %12s %8s\n', compared.delay, unit, ...
    'joint', 'rms', 'most', 'in row');
for j = 1:columns
    mrlab.internal.say('%5d %12.4g %12.4g %8d\n', j, compared.rms(j), compared.most(j), ...
        compared.row(j));
end
end
