function [q, fs] = fromBag(varargin)
%FROMBAG Read a motion from a ROS bag or any file that the lab reads.
%   [Q, FS] = mrlab.fromBag(FILE) sends a bag (.mcap, .db3, or the folder that holds one), a
%   table or a workspace to the lab and returns the joint positions, a row a frame, rad, and the
%   rate, Hz. A gripper is the last column.
%
%   mrlab.fromBag(LAB, FILE, 'robot', 'ur5e', ...) takes the options of mrlab.check.
%
%   Errors: the first finding's where the lab does not read the file, such as mrlab:unevenSampling.
%
%   See also mrlab.compare.

[lab, motion] = mrlab.internal.arguments(varargin, {});
path = char(motion.q);
if exist(path, 'dir')
    inside = [dir(fullfile(path, '*.mcap')); dir(fullfile(path, '*.db3'))];
    if numel(inside) ~= 1
        error('mrlab:noSingleBag', '%s holds %d bags; name the file.', path, numel(inside));
    end
    path = fullfile(path, inside(1).name);
elseif ~exist(path, 'file')
    error('mrlab:noFile', 'There is no file %s.', path);
end
report = mrlab.Report(mrlab.internal.send(lab, motion, false, path));
raise(report);
folder = tempname();
mkdir(folder);
removed = onCleanup(@() rmdir(folder, 's'));
into = fullfile(folder, 'motion.mat');
mrlab.internal.request(lab, 'GET', ['/api/live/' report.draft '/file?format=mat'], [], into);
content = load(into);
q = content.q;
fs = double(content.fs);
end
