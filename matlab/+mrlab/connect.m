function lab = connect(url, varargin)
%CONNECT Sign in at a lab, once.
%   LAB = mrlab.connect(URL) signs in at the lab whose pages are at URL, such as
%   'http://127.0.0.1:8080'. The first time it shows a code: open the address that it prints, and
%   confirm the code there, and choose as what: a student checks, shows and publishes, an operator
%   plays robots, too. The sign-in is kept in the preferences folder, and ends on the page
%   People, under devices. Without URL the lab of last time is meant.
%
%   mrlab.connect(URL, 'token', TOKEN) takes a token from "mrlab users token" instead.
%   mrlab.connect(URL, 'ca', FILE) trusts the lab's own authority, which its page /ca offers.
%   mrlab.connect(URL, 'robot', MODEL) checks motions for that model; else it is the model of the
%   lab's first robot.
%
%   LAB is a structure that the other functions take as their first argument; left out, the lab of
%   the last mrlab.connect is meant.
%
%   Errors: mrlab:noAnswer where no lab answers, mrlab:notConfirmed where nobody confirms the code,
%   mrlab:noRobotModel where the lab has no such model.
%
%   See also mrlab.check, mrlab.show, mrlab.play.

options = mrlab.internal.pairs(varargin, {'token', 'ca', 'robot'});
if nargin < 1 || isempty(url)
    known = mrlab.internal.remember();
    if isempty(known)
        url = 'http://127.0.0.1:8080';
    else
        url = known.url;
    end
end
url = regexprep(strtrim(char(url)), '/+$', '');
if isempty(regexp(url, '^https?://', 'once'))
    url = ['http://' url];
end
lab = struct('url', url, 'token', '', 'ca', '', 'robot', '', 'user', '');
known = mrlab.internal.remember(url);
if ~isempty(known)
    lab = known;
end
for name = fieldnames(options)'
    lab.(name{1}) = char(options.(name{1}));
end
user = whoami(lab);
if isempty(user) && ~isempty(lab.token) && isfield(options, 'token')
    error('mrlab:notSignedIn', '%s does not know this token. Make one: mrlab users token', url);
end
if isempty(user)
    lab = let_in(lab);
    user = whoami(lab);
end
lab.user = user.name;
if isfield(options, 'robot')
    check_model(lab);
else
    lab.robot = first_robot(lab);
end
mrlab.internal.remember(lab);
if isempty(lab.robot)
    robot = 'name a model with each check, such as ''robot'', ''ur5e''';
else
    robot = ['motions are checked for ' lab.robot];
end
mrlab.internal.say('Connected with %s as %s; %s.\n', url, lab.user, robot);
% The preferences folder has the token; a struct is printed and saved with all that it holds.
lab.token = '';
end

function user = whoami(lab)
session = mrlab.internal.request(lab, 'GET', '/api/session');
user = session.user;
end

function lab = let_in(lab)
begun = mrlab.internal.request(lab, 'POST', '/api/pairings', ...
    struct('device', mrlab.internal.program(), 'program', true));
mrlab.internal.say('Open %s\nand confirm the code %s there.\n', begun.url, begun.code);
while true
    found = mrlab.internal.request(lab, 'GET', ['/api/pairings/' begun.secret]);
    if strcmp(found.state, 'approved')
        lab.token = found.token;
        return
    elseif strcmp(found.state, 'expired')
        error('mrlab:notConfirmed', ...
            'Nobody confirmed the code %s in time. Call mrlab.connect again.', begun.code);
    end
    pause(1);
end
end

function check_model(lab)
found = mrlab.internal.request(lab, 'GET', '/assets/robots.json');
known = {found.robots.id};
if ~any(strcmp(lab.robot, known))
    error('mrlab:noRobotModel', 'There is no robot ''%s''; there are: %s.', lab.robot, ...
        strjoin(known, ', '));
end
end

function model = first_robot(lab)
% The model of the lab's first robot; empty: it has none, or does not answer now.
model = '';
try
    found = mrlab.internal.request(lab, 'GET', '/api/robots');
catch problem
    if strncmp(problem.identifier, 'mrlab:', 6)
        return
    end
    rethrow(problem);
end
if ~isempty(found.robots)
    model = found.robots(1).model;
end
end
