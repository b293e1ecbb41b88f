"""Starts the node that watches robots by the clauses: `ros2 launch ros/launch/tautline.launch.py config:=my.toml`.

`cargo install --path ros` puts the program where it is found. It is no package of ament, so it is started as a process.
"""

from pathlib import Path

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    sample = str(Path(__file__).parent / "tautline.toml")
    return LaunchDescription([
        DeclareLaunchArgument("config", default_value=sample, description="robots, topics and clauses, in TOML"),
        ExecuteProcess(cmd=["tautline-ros", LaunchConfiguration("config")], output="screen"),
    ])
