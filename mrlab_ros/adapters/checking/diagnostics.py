"""What a check in the scene of a running lab refuses."""

from mrlab_ros.core.base.diagnostic import Code

TOO_LONG_FOR_LAB = Code(
    "too_long_for_lab",
    "'{trajectory}' lasts {duration:time}; expected {most:time} at most in the lab.",
    "Download it and check it on your own machine.",
)
NOT_IN_LAB = Code(
    "not_in_lab",
    "There is no robot '{robot}' in the lab[; its robots are: {robots:list}].",
)
FOR_ANOTHER_MODEL = Code(
    "for_another_model",
    "'{trajectory}' is for {found}, and {robot} is a {model}; load it on a {found}.",
)
CHECK_OUT_OF_MEMORY = Code(
    "check_out_of_memory", "The check needs more than {most:bytes} of memory."
)
