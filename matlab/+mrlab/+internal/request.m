function answer = request(lab, method, address, body, into)
%REQUEST Ask the lab over HTTP; the only place that knows how MATLAB and Octave do that.
%   body: a structure, sent as JSON; the path of a file, sent as it is; [] or left out: none.
%   into: path of the file that takes the answer; left out: the answer is decoded from JSON.
%   Throws what the lab refuses as an error with the identifier of its code.
%
%   Octave's webwrite sends forms only, so Octave runs curl, which Linux, macOS and Windows have.
if nargin < 4
    body = [];
end
if isempty(lab.token)
    known = mrlab.internal.remember(lab.url);
    if ~isempty(known)
        lab.token = known.token;
    end
end
if mrlab.internal.octave()
    [status, bytes] = by_curl(lab, method, address, body);
else
    [status, bytes] = by_matlab(lab, method, address, body);
end
if status >= 200 && status < 300 && nargin > 4
    file = fopen(into, 'w');
    fwrite(file, bytes);
    fclose(file);
    answer = into;
    return
end
text = native2unicode(reshape(bytes, 1, []), 'UTF-8');
try
    answer = jsondecode(text);
catch
    answer = [];
end
if status >= 200 && status < 300 && ~isempty(answer)
    return
end
if ~isstruct(answer) || ~isfield(answer, 'error')
    error('mrlab:noLab', '%s is no lab: it answered %d.', lab.url, status);
end
problem = answer.error;
if strcmp(problem.kind, 'not_signed_in')
    problem.remedy = sprintf('Sign in again: mrlab.connect(''%s'')', lab.url);
end
error(mrlab.internal.identifier(problem.code), '%s', ...
    strtrim([problem.message ' ' problem.remedy]));
end

function [status, bytes] = by_matlab(lab, method, address, body)
headers = matlab.net.http.HeaderField('Accept', 'application/json');
if ~isempty(lab.token)
    headers(end + 1) = matlab.net.http.HeaderField('Authorization', ['Bearer ' lab.token]);
end
content = matlab.net.http.MessageBody();
if isstruct(body)
    content.Payload = unicode2native(jsonencode(body), 'UTF-8');
    headers(end + 1) = matlab.net.http.HeaderField('Content-Type', 'application/json');
elseif ~isempty(body)
    file = fopen(body, 'r');
    content.Payload = fread(file, Inf, '*uint8')';
    fclose(file);
    headers(end + 1) = matlab.net.http.HeaderField('Content-Type', 'application/octet-stream');
end
if isempty(body)
    message = matlab.net.http.RequestMessage(method, headers);
else
    message = matlab.net.http.RequestMessage(method, headers, content);
end
options = matlab.net.http.HTTPOptions('ConvertResponse', false, 'SavePayload', true);
if ~isempty(lab.ca)
    options.CertificateFilename = lab.ca;
end
try
    response = message.send(matlab.net.URI([lab.url address], 'literal'), options);
catch why
    error('mrlab:noAnswer', 'No lab answers at %s: %s', lab.url, why.message);
end
status = double(response.StatusCode);
bytes = response.Body.Payload;
end

function [status, bytes] = by_curl(lab, method, address, body)
% What is secret stands in a file that only this user reads, never on a command line.
folder = tempname();
mkdir(folder);
removed = onCleanup(@() empty(folder));
answered = fullfile(folder, 'answer');
lines = {['url = "' lab.url address '"'], ['request = "' method '"'], ...
    ['output = "' slashes(answered) '"'], 'write-out = "%{http_code}"', ...
    'silent', 'show-error', 'globoff', 'connect-timeout = 10', ...
    'header = "Accept: application/json"', 'header = "Expect:"'};
if ~isempty(lab.token)
    lines{end + 1} = ['header = "Authorization: Bearer ' lab.token '"'];
end
if ~isempty(lab.ca)
    lines{end + 1} = ['cacert = "' slashes(lab.ca) '"'];
end
if isstruct(body)
    sent = fullfile(folder, 'body');
    mrlab.internal.private_file(sent, jsonencode(body));
    lines{end + 1} = 'header = "Content-Type: application/json"';
    lines{end + 1} = ['data-binary = "@' slashes(sent) '"'];
elseif ~isempty(body)
    lines{end + 1} = 'header = "Content-Type: application/octet-stream"';
    lines{end + 1} = ['upload-file = "' slashes(body) '"'];
end
config = fullfile(folder, 'curl');
mrlab.internal.private_file(config, sprintf('%s\n', lines{:}));
[failed, said] = system(['curl --config "' config '" 2>&1']);
if failed == 127
    error('mrlab:noCurl', 'Octave needs the program curl, which is not there.');
elseif failed ~= 0
    % Without an answer curl prints the code of none, 000, too.
    error('mrlab:noAnswer', 'No lab answers at %s: %s', lab.url, ...
        strtrim(regexprep(said, '000\s*$', '')));
end
status = str2double(said);
bytes = uint8([]);
if exist(answered, 'file')
    file = fopen(answered, 'r');
    bytes = fread(file, Inf, '*uint8')';
    fclose(file);
end
end

function empty(folder)
delete(fullfile(folder, '*'));
rmdir(folder);
end

function text = slashes(path)
text = strrep(strrep(path, '\', '\\'), '"', '\"');
end
