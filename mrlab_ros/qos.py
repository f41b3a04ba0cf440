"""The qualities of service that the graph uses."""

from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

# State: the newest value, also for who comes late (a latched topic).
LATCHED = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
# Events: every one arrives, in order.
EVENTS = QoSProfile(depth=100, reliability=ReliabilityPolicy.RELIABLE)
# Motion: every frame arrives, also at a reader that stalls for seconds; one that wants the newest
# only asks for best effort.
STREAM = QoSProfile(depth=1000, reliability=ReliabilityPolicy.RELIABLE)
# State whose every change counts: as latched, and changes in quick succession all arrive.
LATCHED_EVENTS = QoSProfile(
    depth=10,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
