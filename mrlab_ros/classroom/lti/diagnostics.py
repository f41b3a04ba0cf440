"""Diagnostics of LTI: launches, the course, and what is handed in for it."""

from mrlab_ros.core.base.diagnostic import INFO, Code, Fix

NO_LTI = Code(
    "no_lti",
    "This lab belongs to no course of a learning platform.",
    "Start it with the platform's file.",
)
LTI_WITHOUT_CLASS = Code(
    "lti_without_class",
    "People of a course hand in for a class, and no class is named.",
    "Name its folder, which may be empty.",
)
WITH_CLASS = (Fix(command="mrlab up --keys keys --lti lti.yaml --class FOLDER"),)
LTI_OTHER_PLATFORM = Code(
    "lti_other_platform", "The launch is of another platform or client[: {issuer}]."
)
LTI_OTHER_DEPLOYMENT = Code(
    "lti_other_deployment",
    "The launch is of the deployment '{deployment}', not of {known:either}.",
)
LTI_OTHER_COURSE = Code(
    "lti_other_course",
    "The launch is of the course '{course}'[ ({title})], not of {known:either}.",
    "If it shall belong to this lab, write its id into the file of the platform.",
)
LTI_USED = Code("lti_used", "This launch was used already.", "Open the lab from the course again.")
LTI_NOT_UNDERSTOOD = Code(
    "lti_not_understood", "The launch of the platform is not as LTI 1.3 has it: {why:problem}."
)
LTI_KEY_UNUSABLE = Code(
    "lti_key_unusable", "The key {path} cannot be read or written: {why:problem}."
)
NO_COURSE = Code(
    "no_course",
    "No course is connected yet.",
    "Open the lab from the course, signed in as its teacher.",
)
COURSE_SILENT = Code(
    "course_silent",
    "The platform {issuer} does not answer as it should: {why:problem}.",
    "Try again in a moment.",
)
COURSE_OFFERS_NOT = Code(
    "course_offers_not",
    "The platform does not offer the {what:choice members=list of the course's people"
    "|scores=gradebook} to this lab.",
    "Allow it in the platform's settings of the tool, then open the lab from the course again.",
)
COURSE_LEADS_AWAY = Code(
    "course_leads_away", "The platform names an address of another host: {address}."
)
NOT_OF_COURSE = Code(
    "not_of_course",
    "Only who came from the course can hand in.",
    "Open the lab from the course.",
)
NOTHING_TO_HAND_IN_FOR = Code(
    "nothing_to_hand_in_for",
    "There is no task yet.",
    "Wait until your teacher has put it there.",
)
NOTHING_HANDED_IN = Code("nothing_handed_in", "Nobody has handed in anything yet.")
MARKS_OF_ANOTHER_FORM = Code(
    "marks_of_another_form",
    "These marks are not of what was handed in here, so the course does not know whose they are.",
    "Mark what was handed in, or use the worksheet.",
)
MARKS_SENT = Code(
    "marks_sent", "{count:count mark is|marks are} in the course's gradebook.", severity=INFO
)
MARK_NOT_SENT = Code(
    "mark_not_sent", "The mark of {student} did not reach the course: {why:problem}."
)
CHECKED_AT_ONCE = Code(
    "checked_at_once",
    "{passed:count test passes|tests pass}[, {lost:count needs|need} work].",
    severity=INFO,
)
