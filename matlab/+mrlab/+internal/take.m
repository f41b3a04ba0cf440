function [taken, motion] = take(motion, names)
%TAKE Options that are for somebody else than the conversion, out of those of a motion.
taken = struct();
for i = 1:numel(names)
    if isfield(motion.options, names{i})
        taken.(names{i}) = motion.options.(names{i});
        motion.options = rmfield(motion.options, names{i});
    end
end
end
