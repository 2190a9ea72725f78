"""Traces of nanoplc-sim and seqc verify, and the symbols of their programs."""

import csv
import json
from pathlib import Path

HEADER = "time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist".split(",")
WORD = 0x10000  # a trace has no sign
MOTION = ("p_ist", "v_ist")  # empty in a course of seqc verify's
# Of the motors that a program can be for, where no trace says it; a program for a MIDI drive is in a JVL motor's counts.
MAC800, OTHERS = (8000, 770), (4096, 3125 / 6)  # counts a turn, samples a second


class Bad(Exception):
    pass


def text_of(path):
    """The text in a file, whichever editor wrote it: as hal/host/text_file.cpp has it."""
    try:
        content = Path(path).read_bytes()
    except OSError as error:
        raise Bad(f"{path}: {error.strerror}") from error
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise Bad(f"{path}: it is text in UTF-16; save it as UTF-8")
    if b"\0" in content:
        raise Bad(f"{path}: it is no text, for it holds zeros")
    return content.rstrip(b"\x1a").decode("utf-8-sig", errors="replace")


def read(path):
    try:
        rows = list(csv.reader(text_of(path).splitlines()))
    except csv.Error as error:
        raise Bad(f"{path}: not a trace; its first line must be {','.join(HEADER)}") from error
    if not rows or rows[0] != HEADER:
        raise Bad(f"{path}: not a trace; its first line must be {','.join(HEADER)}")
    trace = []
    for number, row in enumerate(rows[1:], start=2):
        if not any(cell.strip() for cell in row):
            continue
        if len(row) != len(HEADER):
            raise Bad(f"{path}:{number}: {len(row)} fields where {len(HEADER)} are wanted")
        try:
            trace.append({name: value if name == "command" or (name in MOTION and not value) else float(value)
                          for name, value in zip(HEADER, row)})
        except ValueError as error:
            raise Bad(f"{path}:{number}: {error}") from error
    if len(trace) < 2:
        raise Bad(f"{path}: nothing to draw, fewer than two rows")
    return trace


class Symbols:
    """F.sym, as `seqc build` writes it beside F.bin and `nanoplc-sim run --trace T.csv` as T.csv.sym."""

    def __init__(self, path):
        self.path = path
        try:
            file = json.loads(text_of(path))
            if file["format"] != "nanoplc-symbols" or file["version"] not in (1, 2):
                raise Bad(f"{path}: no symbol file of version 1 or 2; name the F.sym that seqc build wrote with the table")
            self.program = str(file["program"])
            self.crc32 = str(file["table"]["crc32"])
            self.steps = {int(step["number"]): str(step["name"]) for step in file["steps"]}
            # A step of a later CALL of a SEQUENCE is a copy too, and a place of its own.
            self.copies = {int(step["number"]): int(step["copy_of"]) for step in file["steps"]
                           if "copy_of" in step and str(step.get("made_for", "")).startswith("copy of ")}
            names = [("IN", file["inputs"]), ("OUT", file["outputs"])]
            self.signals = {f"{kind}{i}": str(name) for kind, all_names in names for i, name in enumerate(all_names)}
            for i in file.get("inverted_inputs", []):  # what is drawn is the wire
                self.signals[f"IN{int(i)}"] = f"NOT {self.signals[f'IN{int(i)}']}"
            free = {entry.get("register") for entry in file.get("set_points", [])}
            self.initial = {int(entry["number"]): int(entry["initial"]) for entry in file["registers"]
                            if "initial" in entry and entry["number"] not in free}
            self.read_units(file)
        except json.JSONDecodeError as error:
            raise Bad(f"{path}:{error.lineno}:{error.colno}: this is not JSON; name the F.sym that seqc build wrote") from error
        except (AttributeError, KeyError, RecursionError, TypeError, ValueError, ZeroDivisionError) as error:
            raise Bad(f"{path}: no symbol file; name the F.sym that seqc build wrote with the table") from error

    def read_units(self, file):
        told = file.get("trace")
        counts, samples = (told["counts_per_rev"], told["samples_per_second"]) if told else (MAC800 if file["motor"] == "MAC800" else OTHERS)
        self.units = {}
        scale = file.get("scale")
        length = float(scale["length"]) / float(scale["revolutions"]) if scale else 1
        unit = str(scale["unit"]) if scale else "rev"
        self.units["p_ist"] = (length / counts, unit)
        self.units["v_ist"] = (samples / counts * length, f"{unit}/s") if scale else (samples / counts * 60, "rpm")


def first_writes(trace):
    """What was first written to each register."""
    writes = {}
    for row in trace:
        for word in row["command"].split():
            register, found, value = word.partition("=")
            if found and register.isdigit():
                writes.setdefault(int(register), int(value))
    return writes


def check_fit(trace, trace_path, symbols, own):
    """Whether the symbols can be those of the trace's program; `own`: what stands beside it, or None."""
    advice = "name the F.sym of the program that was traced"
    if own is not None and own.crc32 != symbols.crc32:
        raise Bad(f"{symbols.path}: is of {symbols.program}, table CRC-32 {symbols.crc32}; {trace_path} is of {own.program}, "
                  f"{own.crc32}; {advice}")
    for row in trace:
        if int(row["step"]) not in symbols.steps:
            raise Bad(f"{symbols.path}: {symbols.program} has no step {int(row['step'])}, where {trace_path} is at "
                      f"{row['time_ms']:g} ms; {advice}")
    writes = first_writes(trace)
    for register, value in symbols.initial.items():
        differs = register not in writes or (writes[register] - value) % WORD != 0
        if differs and any(r in writes for r in symbols.initial):
            raise Bad(f"{symbols.path}: {symbols.program} begins by writing {value} to register {register}, "
                      f"{trace_path} does not; {advice}")


def without_copies(trace, symbols):
    """The trace with the steps of the program: a step that blinks, or waits for an edge, is one."""
    return [row | {"step": symbols.copies.get(int(row["step"]), row["step"])} for row in trace]


def symbols_for(trace, trace_path, named):
    """Those that are named, or those beside the trace; None for neither."""
    beside = Path(f"{trace_path}.sym")
    own = Symbols(beside) if beside.is_file() else None
    symbols = Symbols(named) if named else own
    if symbols is not None:
        check_fit(trace, trace_path, symbols, own)
    if named and own is not None and own.units:
        symbols.units = own.units  # of the motor that ran
    return symbols
