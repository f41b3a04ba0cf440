"""What is said of files that cannot be read as workspaces."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

SAVE_AGAIN = (("", "", "save('traj.mat', 'q')"),)
# how a process ended: its exit status, or the signal and what it means
ENDED = "[ (exit code {exit:integer})][ (signal {signal:integer}[, {meaning}])][ ({error})]"

MISSING = Code(
    "missing",
    "There is no file '{file}'[; did you mean '{close}'?].",
    "Check the folder and the name; the file ends in .mat.",
    meaning="There is no such file.",
    fixes=(("", "", "dir('*.mat')"),),
)
UNSUPPORTED_FORMAT = Code(
    "unsupported_format",
    "'{file}' is {form:choice folder=a folder|special=no ordinary file|empty=an empty file|"
    "version=a MAT file of an unknown version|header=a MATLAB file whose header is damaged|"
    "zip=a ZIP archive (or an Office, .mlx or .slx file)|"
    "spreadsheet=a spreadsheet (save the sheet as CSV UTF-8 and convert that file)|"
    "numpy=a NumPy array (save it so: np.savez('traj.npz', q=q, fs=100))|"
    "png=a PNG picture|jpeg=a JPEG picture|gif=a GIF picture|pdf=a PDF document|"
    "lfs=a Git LFS pointer (the file itself was not downloaded)|"
    "octave=an Octave file (save it with: save -7 traj.mat q)|"
    "seven_zip=a 7-Zip archive|rar=a RAR archive|elf=a program|exe=a Windows program|"
    "bzip=a bzip2 archive|xz=an xz archive|"
    "sqlite=an SQLite database but no whole rosbag2 bag|"
    "html=a web page (was the download page saved instead of the file?)|text=a text file|"
    "unknown=a file of an unknown kind}[ ({detail})], not a MATLAB workspace.",
    "In MATLAB: save('traj.mat', 'q') and convert traj.mat.",
    meaning="The file is not a MATLAB workspace, and what it is instead.",
    fixes=SAVE_AGAIN,
)
UNREADABLE = Code(
    "unreadable",
    "'{file}' is damaged: {why:problem}.",
    "Copy the file again, or save it again in MATLAB: save('traj.mat', 'q').",
    meaning="The file is a workspace but damaged or cut short; nothing of it is taken.",
    fixes=SAVE_AGAIN,
)
BAD_TABLE = Code(
    "bad_table",
    "'{file}' cannot be read as a table: {why:problem}.",
    "Write numbers with a decimal point, one row a sample, under one row of headings; in MATLAB: "
    "writematrix([[t q]], 'traj.csv'), or save('traj.mat', 'q', 't').",
    meaning="A text file is no table of numbers with one row a sample.",
    fixes=(("", "", "writematrix([t q], 'traj.csv')"),),
)
CONVERTER_FAILED = Code(
    "converter_failed",
    "The converter failed on '{file}' ({error}); this is a fault of the converter.",
    "Save only the trajectory: save('traj.mat', 'q'), and report the fault with the file.",
    meaning="The converter itself failed on the file; nothing of it is taken, and the next file "
    "is.",
    fixes=SAVE_AGAIN,
)
READER_DIED = Code(
    "reader_died",
    "'{file}' brought the file reader down" + ENDED + "; the file is damaged or made to do so.",
    "Save it again in MATLAB: save('traj.mat', 'q').",
    meaning="The process that reads files ended while reading this one; the lab goes on.",
    fixes=SAVE_AGAIN,
)
READERS_DISAGREE = Code(
    "readers_disagree",
    "'{variable}' of '{file}' cannot be trusted, as two readers disagree: {why:problem}.",
    "Save it again in MATLAB and send the new file: save('traj.mat', 'q', '-v7').",
    meaning="Two independent readers do not find the same numbers: the file is damaged.",
    fixes=SAVE_AGAIN,
)
SECOND_READER_CRASHED = Code("second_reader_crashed", "the second reader crashed on it" + ENDED)
TOO_LARGE = Code(
    "too_large",
    "'{file}' is too large: {part:choice file=it has|bag=the bag has|numbers=its matrices hold|"
    "variable=one of its variables holds|inflated=it inflates to|reading=reading it needs|"
    "converting=converting it needs} more than {limit:bytes}[, namely {size:bytes}].",
    "Save only the trajectory: save('traj.mat', 'q').",
    meaning="The file, or what it inflates to, passes the limit on size or memory.",
    fixes=SAVE_AGAIN,
)
TOO_SLOW = Code(
    "too_slow",
    "'{file}' could not be read within {limit:time} and was stopped.",
    "Save only the trajectory: save('traj.mat', 'q').",
    meaning="Reading the file passed the time limit and was stopped.",
    fixes=SAVE_AGAIN,
)
NO_ROOM = Code(
    "no_room_for_trajectory",
    "The lab has no room for '{file}' ({error}).",
    "Make room on the disk[ of {folder}], then convert the file again.",
)
WAITING_FILES = Code(
    "waiting_files",
    "{count:count file|files} with {size:bytes} wait to be converted already.",
    "Send this one again in a minute.",
)

# why a file is damaged, or no table
FILE_CHANGED = Code(
    "file_changed_meanwhile",
    "it was changed while it was read; save it completely, then retry",
)
NOT_INFLATED = Code("not_inflated", "the {form} file cannot be inflated ({why:problem})")
READER_FAILED = Code("file_reader_failed", "the reader failed on it ({error})")
NO_TEXT = Code("no_text", "byte {byte:integer} is not {encoding} text")
CELLS_UNREADABLE = Code("cells_unreadable", "its cells cannot be read ({error})")
LABVIEW_SEGMENTS = Code(
    "labview_segments",
    "its LabVIEW header ends {count:count time|times} where a file of one segment has 2; export "
    "one segment",
)
NO_NUMBERS = Code("no_numbers", "it holds no row of numbers")
UNITS_UNKNOWN = Code(
    "units_unknown", "its row of units has '{found}', which is no unit that is known here"
)
WRONG_CELL = Code(
    "wrong_cell",
    "line {line:integer} has '{found}' where a {expected:choice number=number|date=date} is "
    "expected",
)
EMPTY_CELLS = Code("empty_cells", "line {line:integer} has empty cells where numbers are expected")
LINES_DIFFER = Code(
    "lines_differ",
    "line {line:integer} has {count:count value|values} and the first {first:integer}",
)
TWO_DATES = Code("two_dates", "it has dates in {count:integer} columns; keep one of them")
COMMAS_TWICE = Code(
    "commas_twice",
    "commas are its decimal point and separate its columns as well: each row has {count:integer} "
    "values[ under {headings:count heading|headings}]; export it with semicolons between the "
    "columns",
)
# how two readers differ
SECOND_CANNOT_READ = Code("second_cannot_read", "{reader} cannot read it ({error})")
SECOND_FINDS_TYPE = Code("second_finds_type", "{reader} finds values of the type {found}")
SECOND_FINDS_SIZE = Code("second_finds_size", "{reader} finds {size} values")
SECOND_FINDS = Code(
    "second_finds",
    "{reader} finds {second} where {first} was read (row {row:integer}, column {column:integer}"
    "[, page {page:integer}]; {count:integer} of {total:integer} values differ)",
)
# what is known of an object that was not opened
OBJECT_UNREADABLE = Code("object_unreadable", "mat-io cannot read it ({error})")
TOO_MANY_PARTS = Code("too_many_parts", "it has more than {most:integer} parts")
NUMBERS_DIFFER = Code("numbers_differ", "two readers find different numbers in it")
ENUMERATION = Code("enumeration", "an enumeration: {names:list}")
CATEGORIES = Code("categories", "one of {names:either}")
