"""The sandbox of readers of files from outside: the kernel lets their process open nothing else.

A file can ask its reader for others: HDF5 has external datasets, links and references, a robot
description runs expressions, a picture or a mesh names its parts. Which ways there are is the
libraries' business and changes with them, so the sandbox does not look for them. `shut` takes from
the process, for good and from all that it forks, the right to open files, to connect, to start
programs and to signal others; `nothing_opens` leaves no descriptor for a new file while a reader
works. Landlock (Linux 5.13) decides by folder, seccomp by system call; a kernel without them
leaves the limits of `confine` and `nothing_opens`. `layers` says which there are.
"""

from __future__ import annotations

import contextlib
import ctypes
import mmap
import os
import platform
import resource
import struct
import sys
import sysconfig
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from importlib import machinery
from pathlib import Path

PR_SET_NO_NEW_PRIVS, PR_GET_SECCOMP, PR_SET_SECCOMP, SECCOMP_MODE_FILTER = 38, 21, 22, 2

# Landlock: numbers of its calls, equal on all machines, and linux/landlock.h
CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446
RULE_PATH_BENEATH = 1
EXECUTE, WRITE_FILE, READ_FILE, READ_DIR = 1 << 0, 1 << 1, 1 << 2, 1 << 3
TRUNCATE = 1 << 14
# rights of files alone; a rule for a file may name no others
OF_FILES = EXECUTE | WRITE_FILE | READ_FILE | TRUNCATE | 1 << 15
# what each version of Landlock knows of files, TCP, and signals and abstract sockets
FILES = {1: (1 << 13) - 1, 2: (1 << 14) - 1, 3: (1 << 15) - 1, 5: (1 << 16) - 1}
TCP, SCOPES = {4: 0b11}, {6: 0b11}
TO_READ = READ_FILE | READ_DIR
# of a folder that is written to: all but programs, devices, sockets and links
TO_WRITE = TO_READ | WRITE_FILE | TRUNCATE | 1 << 4 | 1 << 5 | 1 << 7 | 1 << 8 | 1 << 13

# seccomp: linux/filter.h, linux/seccomp.h, linux/audit.h
LOAD, JUMP, EQUAL, ANY_BIT, RETURN = 0x20, 0x05, 0x15, 0x45, 0x06
ALLOW, ERROR = 0x7FFF0000, 0x00050000
NUMBER, ARCHITECTURE, ARGUMENTS = 0, 4, 16
EPERM, ENOSYS = 1, 38
ARCHITECTURES = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}

# System calls by name, with their number on x86_64 and on aarch64 (None: it has none); from the
# kernel's tables. What Python and NumPy need that have everything open already:
CALLS = {
    "read": (0, 63), "write": (1, 64), "close": (3, 57), "fstat": (5, 80), "lseek": (8, 62),
    "mmap": (9, 222), "mprotect": (10, 226), "munmap": (11, 215), "brk": (12, 214),
    "rt_sigaction": (13, 134), "rt_sigprocmask": (14, 135), "rt_sigreturn": (15, 139),
    "pread64": (17, 67), "pwrite64": (18, 68), "readv": (19, 65), "writev": (20, 66),
    "sched_yield": (24, 124), "mremap": (25, 216), "msync": (26, 227), "madvise": (28, 233),
    "dup": (32, 23), "nanosleep": (35, 101), "getitimer": (36, 102), "setitimer": (38, 103),
    "getpid": (39, 172), "sendfile": (40, 71), "fork": (57, None), "exit": (60, 93),
    "wait4": (61, 260), "fcntl": (72, 25), "fsync": (74, 82), "fdatasync": (75, 83),
    "ftruncate": (77, 46), "gettimeofday": (96, 169), "getrusage": (98, 165),
    "sysinfo": (99, 179), "times": (100, 153), "getuid": (102, 174), "getgid": (104, 176),
    "geteuid": (107, 175), "getegid": (108, 177), "getppid": (110, 173),
    "sigaltstack": (131, 132), "gettid": (186, 178), "futex": (202, 98),
    "sched_getaffinity": (204, 123), "set_tid_address": (218, 96), "fadvise64": (221, 223),
    "clock_gettime": (228, 113), "clock_getres": (229, 114), "clock_nanosleep": (230, 115),
    "exit_group": (231, 94), "waitid": (247, 95), "set_robust_list": (273, 99),
    "fallocate": (285, 47), "getrandom": (318, 278), "memfd_create": (319, 279),
    "membarrier": (324, 283), "rseq": (334, 293),
}  # fmt: skip
# Capabilities for opening files that Landlock allows; none changes a mode, an owner or a time,
# nor the length of a file by its name, which Landlock knows only since its third version.
OPENING = {
    "open": (2, None), "stat": (4, None), "lstat": (6, None), "poll": (7, None),
    "access": (21, None), "dup2": (33, None), "uname": (63, 160), "flock": (73, 32),
    "getdents": (78, None), "getcwd": (79, 17), "chdir": (80, 49),
    "fchdir": (81, 50), "rename": (82, None), "mkdir": (83, None), "rmdir": (84, None),
    "unlink": (87, None), "readlink": (89, None),
    "umask": (95, 166), "statfs": (137, 43), "fstatfs": (138, 44), "getdents64": (217, 61),
    "link": (86, None), "linkat": (265, 37),
    "openat": (257, 56), "mkdirat": (258, 34), "newfstatat": (262, 79), "unlinkat": (263, 35),
    "renameat": (264, 38), "readlinkat": (267, 78), "faccessat": (269, 48), "ppoll": (271, 73),
    "dup3": (292, 24), "pipe2": (293, 59), "renameat2": (316, 276),
    "copy_file_range": (326, 285), "statx": (332, 291), "faccessat2": (439, 439),
}  # fmt: skip
# Calls that are allowed with some values of an argument only: the argument's place, its values.
NEWFSTATAT, AT_EMPTY_PATH = (262, 79), 0x1000  # the C library's fstat
IOCTL, TERMINAL = (16, 29), (0x5401, 0x5413, 0x541B, 0x5450, 0x5451)  # is it one, how wide
PRLIMIT = (302, 261)  # of what is limited here, and raised for a second reader
LIMITS = (resource.RLIMIT_AS, resource.RLIMIT_NOFILE, resource.RLIMIT_CPU, resource.RLIMIT_STACK)
CLONE, NEW_NAMESPACES = (56, 220), 0x7E020080
CLONE3 = (435, 435)  # its flags lie in memory; without it the C library takes clone

# Folders that hold nothing but packages, and what else installers put beside a package.
SITES = ("site-packages", "dist-packages")
DISTRIBUTION = (".dist-info", ".egg-info", ".libs")


def confine(*, memory: int, seconds: float, file_size: int) -> None:
    """Limit this process: bytes beyond those it has, s of a processor, bytes of a file.

    A process that it forks may raise its memory by as much again.
    """
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (file_size, file_size))
    used = address_space()
    resource.setrlimit(resource.RLIMIT_AS, (used + memory, used + 2 * memory))
    whole = int(seconds) + 2
    # SIGXCPU ends it; a SIGKILL is another's
    resource.setrlimit(resource.RLIMIT_CPU, (whole, whole + 5))


def address_space() -> int:
    """Return the size, bytes, of this process' address space."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[0]) * mmap.PAGESIZE


@contextlib.contextmanager
def nothing_opens() -> Iterator[None]:
    """Leave this process no descriptor for a new file, socket or pipe."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (0, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))


def shut(*, read: Iterable[Path] = (), write: Iterable[Path] = (), opens: bool = False) -> None:
    """Let this thread and all that it starts reach no more than is named here, for good.

    They connect nowhere, start no program and signal nobody. read, write: folders and files; those
    to write to can be read too, and what is gone meanwhile is not read. opens: they may open what
    these name; else nothing at all. Raises OSError where the kernel has a layer and does not grant
    it.
    """
    rules = [(path, TO_READ) for path in read] + [(path, TO_WRITE) for path in write]
    if rules and not opens:
        raise ValueError("files are named that nobody may open")
    if opens:
        rules.append((Path(os.devnull), TO_WRITE))
    _prctl(PR_SET_NO_NEW_PRIVS, 1, 0)
    if landlock_version():
        _restrict_files(rules)
    if has_seccomp():
        program = filter_program(opens)
        steps = ctypes.create_string_buffer(program, len(program))
        given = _Program(len(program) // 8, ctypes.addressof(steps))
        _prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, ctypes.byref(given))


def layers() -> dict[str, bool]:
    """Return which layers of the sandbox this machine has."""
    return {"landlock": landlock_version() > 0, "seccomp": has_seccomp()}


def libraries() -> tuple[Path, ...]:
    """Return what a process that imports and computes reads of the system and of Python.

    Of a folder that PYTHONPATH adds, such as a source tree, the packages alone: keys and a
    teacher's solutions may lie beside them.
    """
    own = {*sysconfig.get_paths().values(), sys.prefix, sys.base_prefix}
    named = own | {part for entry in sys.path if entry for part in _importable(Path(entry), own)}
    # packages whose files are links to those in a source tree
    loaded = [m for m in list(sys.modules.values()) if getattr(m, "__path__", None)]
    named |= {str(Path(m.__file__).resolve().parent) for m in loaded if m.__file__}
    named |= set(filter(None, os.environ.get("LD_LIBRARY_PATH", "").split(":")))
    system = ("/usr/lib", "/usr/lib64", "/lib", "/lib64", "/etc/ld.so.cache", "/etc/localtime")
    devices = ("/usr/share/zoneinfo", "/dev/urandom")
    found = {Path(name).resolve() for name in (*named, *system, *devices) if name}
    return tuple(sorted(path for path in found if path.exists() and path != Path("/")))


def _importable(entry: Path, own: Iterable[str]) -> list[str]:
    """Return what Python imports from an entry of its path."""
    if not entry.is_dir() or entry.name in SITES or str(entry) in own:
        return [str(entry)]
    with contextlib.suppress(OSError):
        return [
            str(part)
            for part in entry.iterdir()
            if part.suffix in DISTRIBUTION
            or (part / "__init__.py").is_file()
            or (part.name.endswith(tuple(machinery.all_suffixes())) and part.is_file())
        ]
    return []


@cache
def landlock_version() -> int:
    """Return the version of the kernel's Landlock, 0 without one."""
    return max(int(_libc().syscall(CREATE_RULESET, None, 0, 1)), 0)


@cache
def has_seccomp() -> bool:
    """Return whether the kernel takes filters of system calls, on a machine whose are known."""
    known = platform.machine() in ARCHITECTURES
    return known and _libc().prctl(PR_GET_SECCOMP, 0, 0, 0, 0) >= 0


def _restrict_files(rules: Sequence[tuple[Path, int]]) -> None:
    files, tcp, scopes = (_known(table) for table in (FILES, TCP, SCOPES))
    attributes = struct.pack("<QQQ", files, tcp, scopes)
    size = len(attributes) if scopes else 16 if tcp else 8
    ruleset = _call(CREATE_RULESET, attributes, size, 0)
    try:
        for path, rights in rules:
            try:
                at = os.open(path, os.O_PATH | os.O_CLOEXEC)
            except FileNotFoundError:
                if rights == TO_READ:
                    continue
                raise
            try:
                known = rights & files if os.path.isdir(path) else rights & files & OF_FILES
                _call(ADD_RULE, ruleset, RULE_PATH_BENEATH, struct.pack("<Qi", known, at), 0)
            finally:
                os.close(at)
        _call(RESTRICT_SELF, ruleset, 0)
    finally:
        os.close(ruleset)


def _known(table: dict[int, int]) -> int:
    """Return the newest row of a table that this kernel's Landlock knows."""
    return max((bits for since, bits in table.items() if since <= landlock_version()), default=0)


@cache
def filter_program(opens: bool) -> bytes:
    """Return the filter of system calls: those it names are allowed, all others fail."""
    machine = platform.machine()
    column = list(ARCHITECTURES).index(machine)

    def number(call: tuple[int | None, ...]) -> int:
        """Return the number of a call on this machine, -1 where it has none."""
        found = call[column]
        return -1 if found is None else found

    def argument(place: int) -> int:
        return ARGUMENTS + 8 * place

    def only(call: tuple[int, int], *wanted: tuple[int, Sequence[int]]) -> list[bytes]:
        """Allow a call where the lower halves of these arguments have one of these values each."""
        body: list[bytes] = []
        for place, values in wanted:
            last = len(values) - 1
            body.append(_step(LOAD, argument(place)))
            # each test that holds skips the others and the refusal behind them
            body += [_step(EQUAL, v, yes=last - i + 1) for i, v in enumerate(values)]
            body.append(_fails(EPERM))
        body.append(_allowed())
        return [_step(EQUAL, number(call), no=len(body)), *body]

    named = [number(call) for call in ({**CALLS, **OPENING} if opens else CALLS).values()]
    numbers = [n for n in named if n >= 0]
    clone = [_step(LOAD, argument(0)), _step(ANY_BIT, NEW_NAMESPACES, no=1), _fails(EPERM)]
    steps = [
        _step(LOAD, ARCHITECTURE),
        _step(EQUAL, ARCHITECTURES[machine], yes=1),
        _fails(EPERM),
        _step(LOAD, NUMBER),
        # short, as the kernel compiles it for each process: what is found jumps to one step
        *(_step(EQUAL, n, yes=len(numbers) - i) for i, n in enumerate(numbers)),
        _step(JUMP, 1),
        _allowed(),
        _step(EQUAL, number(CLONE3), no=1),
        _fails(ENOSYS),
        _step(EQUAL, number(CLONE), no=len(clone) + 1),
        *clone,
        _allowed(),
        *only(NEWFSTATAT, (3, (AT_EMPTY_PATH,))),
        *only(IOCTL, (1, TERMINAL)),
        *only(PRLIMIT, (0, (0,)), (1, LIMITS)),
        _fails(EPERM),
    ]
    return b"".join(steps)


def _step(code: int, value: int, *, yes: int = 0, no: int = 0) -> bytes:
    """Return an instruction of the filter; yes, no: how many steps a test skips."""
    return struct.pack("<HBBI", code, yes, no, value & 0xFFFFFFFF)


def _allowed() -> bytes:
    return _step(RETURN, ALLOW)


def _fails(error: int) -> bytes:
    return _step(RETURN, ERROR | error)


@cache
def _libc() -> ctypes.CDLL:
    return ctypes.CDLL(None, use_errno=True)


def _call(number: int, *arguments: object) -> int:
    """Make a system call; raise OSError where it fails."""
    found = int(_libc().syscall(number, *arguments))
    if found < 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    return found


def _prctl(option: int, second: int, third: object) -> None:
    if _libc().prctl(option, second, third, 0, 0):
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))


class _Program(ctypes.Structure):
    _fields_ = (("length", ctypes.c_ushort), ("steps", ctypes.c_void_p))
