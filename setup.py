import re
import sys
from pathlib import Path

from setuptools import find_packages, setup

package_name = "mrlab_ros"
# colcon's symlink install runs a link to this file, in a folder with what it installs alone.
ROOT = Path(__file__).resolve().parent
# Each is an executable of its own, too; the host runs the node that it is named after.
NODES = ("bridge", "converter", "coordinator", "frames", "lab", "physics", "playback", "recorder")


def data_tree(*folders):
    """Pair every file below the folders with its place under share/mrlab_ros."""
    files = [p for f in folders for p in sorted(Path(f).rglob("*")) if p.is_file()]
    return [(f"share/{package_name}/{p.parent}", [str(p)]) for p in files]


def executables():
    """Return what `ros2 run mrlab_ros` finds; in a wheel they would lie in everybody's path."""
    yield "host = mrlab_ros.processes.host:main"
    yield from (f"{node} = mrlab_ros.processes.host:run_named_node" for node in NODES)


def requirements():
    """Return what the lab needs to run: the last part of requirements.in."""
    lines = (
        (ROOT / "requirements.in").read_text().partition("# the lab itself")[2].splitlines()[1:]
    )
    return [line for line in lines if line and not line.startswith("#")]


setup(
    name=package_name,
    version=re.search("<version>(.+)</version>", (ROOT / "package.xml").read_text())[1],
    python_requires=">=3.10",
    packages=find_packages(include=[package_name, f"{package_name}.*"]),
    # Type checkers read py.typed; page.html is the template of report pages.
    package_data={package_name: ["py.typed"], f"{package_name}.app.show": ["page.html"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        *data_tree("config", "robots", "launch", "examples", "web/dist"),
        (f"share/{package_name}/msg_schemas", ["msg_schemas/trajectory.schema.json"]),
    ],
    # ROS's index of packages: of the wheels, or of a ROS machine.
    install_requires=[*requirements(), "ros-ament-index-python"],
    # By which `colcon test` knows that the tests are pytest's.
    extras_require={"test": ["pytest"]},
    zip_safe=False,
    maintainer="MR-Lab maintainers",
    maintainer_email="mrlab@example.org",
    description="A mixed-reality robotics laboratory without robots.",
    long_description=(ROOT / "README.md").read_text(),
    long_description_content_type="text/markdown",
    license="Apache-2.0",
    classifiers=[
        "Environment :: Web Environment",
        "Intended Audience :: Education",
        "Operating System :: POSIX :: Linux",
        "Programming Language :: Python :: 3",
        "Topic :: Scientific/Engineering",
        "Typing :: Typed",
    ],
    entry_points={
        "console_scripts": [
            "mrlab = mrlab_ros.cli:main",
            *(() if {"bdist_wheel", "dist_info"} & {*sys.argv} else executables()),
        ],
    },
)
