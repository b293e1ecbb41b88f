"""The node beside Cyclone DDS, another implementation of DDS with a decoder of its own, by hand:

    python3 -m venv venv && venv/bin/pip install cyclonedds==11.0.1
    cargo build --manifest-path ros/Cargo.toml
    venv/bin/python ros/tests/cyclone.py ros/target/debug/tautline-ros

Cyclone DDS publishes the poses of ros/launch/tautline.toml and takes the diagnostics and the markers. In every half
second, the third robot is out of reach once. Prints the latency of each breach, from before its pose is written to
after its diagnostic is read.
"""

import signal
import subprocess
import sys
import time
import types
from dataclasses import dataclass
from pathlib import Path

from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import array, float32, float64, int32, sequence, uint8, uint32
from cyclonedds.pub import DataWriter
from cyclonedds.qos import Policy, Qos
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

DOMAIN = 23
BREACHES = 40


def message(kind, **fields):
    package, name = kind.split("/")
    body = {"__annotations__": fields, "__module__": __name__}
    typename = f"{package}::msg::dds_::{name}_"
    return dataclass(types.new_class(name, (IdlStruct,), {"typename": typename}, lambda names: names.update(body)))


Time = message("builtin_interfaces/Time", sec=int32, nanosec=uint32)
Header = message("std_msgs/Header", stamp=Time, frame_id=str)
Point = message("geometry_msgs/Point", x=float64, y=float64, z=float64)
Quaternion = message("geometry_msgs/Quaternion", x=float64, y=float64, z=float64, w=float64)
Pose = message("geometry_msgs/Pose", position=Point, orientation=Quaternion)
PoseStamped = message("geometry_msgs/PoseStamped", header=Header, pose=Pose)
Twist = message("geometry_msgs/Twist", linear=Point, angular=Point)
PoseCovariance = message("geometry_msgs/PoseWithCovariance", pose=Pose, covariance=array[float64, 36])
TwistCovariance = message("geometry_msgs/TwistWithCovariance", twist=Twist, covariance=array[float64, 36])
Odometry = message(
    "nav_msgs/Odometry", header=Header, child_frame_id=str, pose=PoseCovariance, twist=TwistCovariance)
KeyValue = message("diagnostic_msgs/KeyValue", key=str, value=str)
Status = message(
    "diagnostic_msgs/DiagnosticStatus", level=uint8, name=str, message=str, hardware_id=str, values=sequence[KeyValue])
Diagnostics = message("diagnostic_msgs/DiagnosticArray", header=Header, status=sequence[Status])
Color = message("std_msgs/ColorRGBA", r=float32, g=float32, b=float32, a=float32)
Image = message("sensor_msgs/CompressedImage", header=Header, format=str, data=sequence[uint8])
UvCoordinate = message("visualization_msgs/UVCoordinate", u=float32, v=float32)
MeshFile = message("visualization_msgs/MeshFile", filename=str, data=sequence[uint8])
Marker = message(
    "visualization_msgs/Marker", header=Header, ns=str, id=int32, type=int32, action=int32, pose=Pose, scale=Point,
    color=Color, lifetime=Time, frame_locked=bool, points=sequence[Point], colors=sequence[Color],
    texture_resource=str, texture=Image, uv_coordinates=sequence[UvCoordinate], text=str, mesh_resource=str,
    mesh_file=MeshFile, mesh_use_embedded_materials=bool)
Markers = message("visualization_msgs/MarkerArray", markers=sequence[Marker])

participant = DomainParticipant(DOMAIN)
reliable = Qos(Policy.Reliability.Reliable(duration(milliseconds=100)), Policy.History.KeepLast(10))


def topic(name, kind):
    return Topic(participant, f"rt{name}", kind, qos=reliable)


poses = [DataWriter(participant, topic(f"/robot_{robot}/pose", PoseStamped), qos=reliable) for robot in (1, 2, 3)]
odometry = DataWriter(participant, topic("/guest/odom", Odometry), qos=reliable)
diagnostics = DataReader(participant, topic("/diagnostics", Diagnostics), qos=reliable)
markers = DataReader(participant, topic("/tautline/markers", Markers), qos=reliable)


def go(third):
    """Publishes a pose of each robot."""
    now = time.time()
    header = Header(Time(int(now), int(now % 1 * 1e9)), "map")
    pose = lambda x, y: Pose(Point(x, y, 0.0), Quaternion(0.0, 0.0, 0.0, 1.0))
    zeros, still = [0.0] * 36, Twist(Point(0.0, 0.0, 0.0), Point(0.0, 0.0, 0.0))
    odometry.write(Odometry(header, "base", PoseCovariance(pose(20.0, 20.0), zeros), TwistCovariance(still, zeros)))
    for writer, x in zip(poses, (0.0, 2.0, third)):
        writer.write(PoseStamped(header, pose(x, 0.0)))


def await_chain(level, act, patience=10.0):
    """The diagnostic of CHAIN-3 once it has a level; `act` is done each tenth of a second."""
    end, due = time.monotonic() + patience, 0.0
    while time.monotonic() < end:
        if act and time.monotonic() >= due:
            act()
            due = time.monotonic() + 0.1
        for sample in diagnostics.take(N=10):
            for status in sample.status:
                if status.name.startswith("tautline: CHAIN-3") and status.level == level:
                    return status
        time.sleep(0.0002)
    sys.exit(f"no diagnostic of level {level} came")


config = Path(__file__).parent.parent / "launch" / "tautline.toml"
node = subprocess.Popen([sys.argv[1], config, "--domain", str(DOMAIN)], stderr=subprocess.DEVNULL)
try:
    await_chain(0, lambda: go(4.0))
    latencies = []
    for _ in range(BREACHES):
        start = time.monotonic()
        go(5.5)
        broken = await_chain(2, None)
        latencies.append(time.monotonic() - start)
        await_chain(0, lambda: go(4.0))
        time.sleep(0.05)
    go(5.5)
    await_chain(2, None)
    time.sleep(0.2)
    print(broken)
    print(next(marker for sample in markers.take(N=100) for marker in sample.markers if marker.type == 5))
    print(await_chain(3, None))
    latencies.sort()
    print(f"{BREACHES} breaches: median {latencies[BREACHES // 2] * 1e3:.2f} ms, longest {latencies[-1] * 1e3:.2f} ms")
finally:
    node.send_signal(signal.SIGINT)
    print(f"the node ended with exit code {node.wait(10)}")
