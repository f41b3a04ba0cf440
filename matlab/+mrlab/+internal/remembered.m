function lab = remembered()
%REMEMBERED The lab of the last mrlab.connect; an error where there is none.
lab = mrlab.internal.remember();
if isempty(lab)
    error('mrlab:notConnected', ...
        'No lab is known. Connect first: lab = mrlab.connect(''http://127.0.0.1:8080'')');
end
end
