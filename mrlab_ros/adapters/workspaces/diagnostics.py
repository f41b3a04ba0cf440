"""Diagnostics of files that cannot be read as workspaces."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

SAVE_AGAIN = (("", "", "save('traj.mat', 'q', '-v7')"),)
# how a process ended: its exit status, or the signal and what it means
ENDED = "[ (exit code {exit:integer})][ (signal {signal:integer}[, {meaning}])][ ({error})]"

MISSING = Code(
    "missing",
    "There is no file '{file}'.[ Did you mean '{close}'?]",
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
    "numpy=a NumPy array|"
    "png=a PNG picture|jpeg=a JPEG picture|gif=a GIF picture|pdf=a PDF document|"
    "lfs=a Git LFS pointer (the file itself was not downloaded)|"
    "octave=an Octave file (save it with: save -7 traj.mat q)|"
    "seven_zip=a 7-Zip archive|rar=a RAR archive|elf=a program|exe=a Windows program|"
    "bzip=a bzip2 archive|xz=an xz archive|"
    "sqlite=an SQLite database but no whole rosbag2 bag|"
    "html=a web page (was the download page saved instead of the file?)|text=a text file|"
    "unknown=a file of an unknown kind}[ ({detail})], not a MATLAB workspace.",
    "Save the joint positions as q, one row a sample, as .mat, .csv, .npz or .json; convert that "
    "file.",
    meaning="The file is not a MATLAB workspace, and what it is instead.",
    fixes=SAVE_AGAIN,
)
UNREADABLE = Code(
    "unreadable",
    "'{file}' is damaged: {why:problem}.",
    "Copy the file again, or save it again[ in Python: {python}].",
    meaning="The file is a workspace but damaged or cut short; nothing of it is taken.",
    fixes=SAVE_AGAIN,
)
BAD_TABLE = Code(
    "bad_table",
    "'{file}' cannot be read as a table: {why:problem}.",
    "Write numbers with a decimal point, one row a sample, under one row of headings; or save a "
    ".mat file in MATLAB.",
    meaning="A text file is no table of numbers with one row a sample.",
    fixes=(("", "", "writematrix([t q], 'traj.csv')"),),
)
CONVERTER_FAILED = Code(
    "converter_failed",
    "The converter failed on '{file}' ({error}); this is a fault of the converter.",
    "Save only the trajectory, and report the fault with the file.",
    meaning="The converter itself failed on the file; nothing of it is taken, and the next file "
    "is.",
    fixes=SAVE_AGAIN,
)
READER_DIED = Code(
    "reader_died",
    "'{file}' brought the file reader down" + ENDED + "; the file is damaged or made to do so.",
    "Save it again in MATLAB.",
    meaning="The process that reads files ended while reading this one; the lab goes on.",
    fixes=SAVE_AGAIN,
)
READERS_DISAGREE = Code(
    "readers_disagree",
    "'{variable}' of '{file}' cannot be trusted, as two readers disagree: {why:problem}.",
    "Save it again in MATLAB and send the new file.",
    meaning="Two independent readers do not find the same numbers: the file is damaged.",
    fixes=(("", "", "save('traj.mat', 'q', '-v7')"),),
)
SECOND_READER_CRASHED = Code("second_reader_crashed", "the second reader crashed on it" + ENDED)
TOO_LARGE = Code(
    "too_large",
    "'{file}' is too large: {part:choice file=it has|bag=the bag has|numbers=its matrices hold|"
    "variable=one of its variables holds|inflated=it inflates to|reading=reading it needs|"
    "converting=converting it needs} more than {limit:bytes}[, namely {size:bytes}].",
    "Save only the trajectory.",
    meaning="The file, or what it inflates to, passes the limit on size or memory.",
    fixes=SAVE_AGAIN,
)
TOO_SLOW = Code(
    "too_slow",
    "'{file}' could not be read within {limit:time}[ of {clock:choice processor=processor time}] "
    "and was stopped.",
    "Save only the trajectory.",
    meaning="Reading the file passed the time limit and was stopped.",
    fixes=SAVE_AGAIN,
)
NO_ROOM = Code(
    "no_room_for_trajectory",
    "The lab has no room for '{file}' ({error}).",
    "Make room on the disk[ of {folder}], then convert the file again.",
)
LAB_FAILED = Code(
    "lab_failed_on_file",
    "The lab could not work on '{file}' ({error}); the file is not at fault.",
    "Convert the file again; if this repeats, look at the memory and the limits of the machine.",
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
HEADINGS_AGAIN = Code(
    "headings_again",
    "line {line:integer} has the headings {headings:list} again: several recordings stand in one "
    "file; keep one of them",
)
MATLAB_COMPUTES = Code(
    "matlab_computes",
    "line {line:integer} computes ({found}); only numbers, texts and matrices of numbers are "
    "read. Run the file in MATLAB, and save the workspace",
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

# what is damaged in the bytes of a workspace
BAD_DIMENSIONS = Code(
    "bad_dimensions",
    "an array has the dimensions {size}; expected {least:integer} to {most:integer} of them, none "
    "negative",
)
BAD_NAME_BYTES = Code("bad_name_bytes", "a name is written as {found}, which MATLAB never writes")
NO_NAME = Code("no_name", "a variable or an object has no name")
SAME_NAME = Code("same_name", "two variables have the name '{variable}'")
ENDS_EARLY = Code("ends_early", "it ends inside an element's tag")
TOO_FEW_BYTES = Code(
    "too_few_bytes",
    "[the numbers of '{variable}' have][the text '{text}' has][{element:choice any=an element "
    "has}] {left:integer} bytes where {needed:integer} are needed",
)
TOO_MANY_BYTES = Code(
    "too_many_bytes",
    "{count:count byte follows|bytes follow} [the contents of '{variable}']"
    "[{behind:choice checksum=the checksum of a compressed variable}]",
)
ODD_BYTES = Code(
    "odd_bytes",
    "{part:choice variable=a variable has|fields=the field names of a struct have} "
    "{count:integer} bytes, which is no multiple of {unit_size:integer}",
)
WRONG_TYPE = Code(
    "wrong_type",
    "{part:choice name=a name has|dimensions=dimensions have|flags=a variable's flags have|"
    "fields=field names have|indices=sparse indices have|numbers=numbers have|text=a text has|"
    "variable=what should be a variable has} the element type {found}"
    "[ (in '{variable}')]",
)
NO_VARIABLE_HERE = Code(
    "no_variable_here",
    "no variable begins where one should[, at byte {byte:integer}]",
)
UNKNOWN_CLASS_NUMBER = Code(
    "unknown_class_number",
    "'{variable}' has the class number {found:integer}, which MATLAB never writes",
)
EMPTY_SUBSYSTEM = Code("empty_subsystem", "the part that holds the contents of objects is empty")
WRONG_INFLATED_SIZE = Code(
    "wrong_inflated_size",
    "a compressed variable inflates to {found:choice less=less|more=more} than the "
    "{declared:integer} bytes that it declares",
)
CUT_BEFORE_CHECKSUM = Code(
    "cut_before_checksum", "a compressed variable is cut off before its checksum"
)
NESTED_TOO_DEEP = Code(
    "nested_too_deep", "'{variable}' is nested deeper than {most:integer} levels"
)
VALUES_ELSEWHERE = Code(
    "values_elsewhere", "'{variable}' takes its values from elsewhere; that is not followed"
)
BAD_ATTRIBUTE = Code("bad_attribute", "the attribute {attribute} of '{variable}' is too large")
NO_REFERENCES = Code("no_references", "'{variable}' holds no references to its elements")
POINTS_NOWHERE = Code("points_nowhere", "'{variable}' points nowhere")
LIBRARY_FAILED = Code(
    "library_failed",
    "{part:choice hdf5=the HDF5 library|bag=the reader of bags|npz=the reader of NumPy's files|"
    "json=the reader of JSON|yaml=the reader of YAML|variable=zlib|"
    "message=the reader of messages} cannot read it ({error})",
)
NO_JSON_OBJECT = Code(
    "no_json_object",
    'it is no JSON object; expected one such as {{"q": [[[[...]], ...]], "fs": 100}}',
)
NO_MESSAGES = Code(
    "no_messages",
    "it holds neither a JointTrajectory (joint_names and points) nor joint states (name and "
    "position)",
)
NO_MATRIX_Q = Code("no_matrix_q", "its frames hold no matrix q; convert the workspace again")
