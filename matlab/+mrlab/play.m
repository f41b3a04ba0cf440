function played = play(varargin)
%PLAY Play a motion on a robot of the lab.
%   mrlab.play(LAB, 'ur5e_1', Q, FS) publishes a motion and plays it on that robot: the robot goes to
%   the first row, then along the motion. Everybody in the room and on the pages sees it. LAB may be
%   left out. Further arguments are those of mrlab.check and mrlab.publish, and
%     'rate', 0.5       at half speed; negative: backwards
%     'replace', true   where the robot moves, pause it and blend to this motion from there; after
%                       a collision stop it first
%
%   mrlab.play(LAB, 'ur5e_1', 'pick') plays a trajectory of the catalogue.
%
%   Errors: the first finding's, such as mrlab:jointLimit, where the lab refuses the motion;
%   mrlab:otherRobot where 'robot' is not that robot's model;
%   mrlab:illegalEvent where the robot moves, and nothing is published then; mrlab:roleTooLow where
%   your role may not play. Findings that do not refuse the motion are warnings.
%
%   See also mrlab.stop, mrlab.state, mrlab.publish.

[lab, motion] = mrlab.internal.arguments(varargin, ...
    {'rate', 'replace', 'id', 'shared'}, 'robot first');
motion.name = inputname(motion.place);
[playing, motion] = mrlab.internal.take(motion, {'rate', 'replace'});
if ischar(motion.q)
    playing.trajectory = motion.q;
else
    robots = mrlab.state(lab);
    robot = robots(strcmp({robots.name}, motion.robot));
    if isempty(robot)
        error('mrlab:noRobot', 'The lab has no robot %s. It has: %s.', motion.robot, ...
            strjoin({robots.name}, ', '));
    end
    if ~any(strcmp(motion.model, {'', robot.model}))
        error('mrlab:otherRobot', '%s is a %s, not a %s. Leave ''robot'' out, or name another robot.', ...
            motion.robot, robot.model, motion.model);
    end
    motion.options.robot_model = robot.model;
    motion.options.end_effector = robot.end_effector;
    playing.publish = mrlab.internal.draft(lab, motion, true);
end
try
    found = mrlab.internal.request(lab, 'POST', ['/api/robots/' motion.robot '/play'], playing);
catch problem
    if strcmp(problem.identifier, 'mrlab:illegalEvent')
        mend = sprintf(['mrlab.play(..., ''replace'', true)\n  or:   mrlab.stop(''%s'')'], ...
            motion.robot);
        if isfield(playing, 'replace') && playing.replace
            mend = sprintf('move the robot, or what it touches, on the page %s/lab', lab.url);
        end
        error(problem.identifier, '%s\n  mend: %s', problem.message, mend);
    end
    rethrow(problem);
end
if nargout > 0
    played = found;
else
    mrlab.internal.say('%s plays %s.\n', found.robot, found.trajectory);
end
end
