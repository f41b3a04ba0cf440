from pathlib import Path

from setuptools import find_packages, setup

package_name = "mrlab_ros"
# Each is an executable of its own, too; the host runs the node that it is named after.
NODES = ("bridge", "converter", "coordinator", "frames", "lab", "physics", "playback", "recorder")


def data_tree(*folders):
    """Pair every file below the folders with its place under share/mrlab_ros."""
    files = [p for f in folders for p in sorted(Path(f).rglob("*")) if p.is_file()]
    return [(f"share/{package_name}/{p.parent}", [str(p)]) for p in files]


setup(
    name=package_name,
    version="0.1.0",
    packages=find_packages(include=[package_name, f"{package_name}.*"]),
    # By which type checkers know that the package has types.
    package_data={package_name: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        *data_tree("config", "robots", "launch", "examples", "web/dist"),
    ],
    install_requires=["setuptools"],
    # By which `colcon test` knows that the tests are pytest's.
    extras_require={"test": ["pytest"]},
    zip_safe=False,
    maintainer="MR-Lab maintainers",
    maintainer_email="mrlab@example.org",
    description="A mixed-reality robotics laboratory without robots.",
    license="Apache-2.0",
    entry_points={
        "console_scripts": [
            "mrlab = mrlab_ros.cli:main",
            "host = mrlab_ros.processes.host:main",
            *(f"{node} = mrlab_ros.processes.host:run_named_node" for node in NODES),
        ],
    },
)
