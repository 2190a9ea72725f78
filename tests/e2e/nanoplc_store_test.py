#!/usr/bin/env python3
"""What nanoplc has stored is damaged, missing, or cannot be written: nothing starts by itself, and every port gives the reason.

usage: nanoplc_store_test.py NANOPLC MACSIM NANOCTL MACREG SEQC MENDING.seq
"""

import base64
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import unittest
import zlib

import modbus_test
import service_case
from panel_client import Panel
from stored_case import SETTINGS, TABLES, SmallDisk, Stored

STORAGE_FAILED = 15  # a result


class Mark(Stored):
    def crash(self, config):
        service = self.start(config)
        self.moves()
        self.end(service, signal.SIGKILL)

    def test_of_a_size_from_the_beginning(self):
        config = self.stored_run()
        size = os.path.getsize(self.mark)
        self.crash(config)
        self.assertEqual(os.path.getsize(self.mark), size)

    def test_any_flipped_bit_after_a_crash_leaves_it_stopped(self):
        config = self.stored_run()
        self.crash(config)
        for offset, reason in ((0, "bad run mark"), (8, "bad run mark"), (52, "bad run mark")):
            self.flip(self.mark, offset)
            service, _ = self.expect_waits(config, reason, "nobody knows whether the last run ended in order")
            self.ctl("run")
            self.moves()
            self.end(service, signal.SIGKILL)

    def test_missing_after_a_crash(self):
        config = self.stored_run()
        self.crash(config)
        os.remove(self.mark)
        self.expect_waits(config, "bad run mark", "nobody knows")
        self.ctl("run")
        self.moves()

    def test_empty_or_something_else(self):
        config = self.stored_run()
        for make in (lambda: open(self.mark, "w", encoding="utf-8").close(), lambda: os.mkfifo(self.mark),
                     lambda: os.symlink("/dev/full", self.mark)):
            os.remove(self.mark)
            make()
            service, _ = self.expect_waits(config, "bad run mark", "nobody knows")
            self.ctl("run")
            self.moves()
            self.end(service)
            self.end(self.start(config))  # it has been written again

    def test_a_folder_in_its_place(self):
        config = self.stored_run()
        os.remove(self.mark)
        os.makedirs(self.mark + "/in_the_way")
        service, status = self.expect_waits(config, "bad run mark", self.mark + ": cannot be written: ")
        self.assertFalse(status["enabled"])
        self.expect_refuses()
        self.ctl("reset")
        self.until_status(lambda status: status["state"] == "stopped" and status["safe_reason"] == "bad run mark")
        self.expect_refuses()
        self.end(service)
        shutil.rmtree(self.mark)
        self.expect_waits(config, "bad run mark", "nobody knows")
        self.ctl("run")
        self.moves()

    def write_mark(self, state):
        """Of an earlier boot."""
        checked = f"{state:7} 01234567-89ab-cdef-0123-456789abcdef ".encode()
        with open(self.mark, "wb") as file:
            file.write(checked + f"{zlib.crc32(checked):08x}\n".encode())

    def test_a_power_cut_in_a_run_starts_as_configured(self):
        config = self.stored_run()
        self.write_mark("running")
        service = self.start(config)
        self.moves()
        self.assertIn("in the middle of a run, and no watchdog says that it did this: a power cut", service.said())
        self.end(service)
        config = self.write(self.axis(), service='after_power_cut = "wait"')
        self.write_mark("running")
        service, _ = self.expect_waits(config, "watchdog", "in the middle of a run")
        self.ctl("run")
        self.moves()
        self.end(service)
        for state in ("ended", "fresh"):
            self.write_mark(state)
            service = self.start(config)
            self.moves()
            self.end(service)

    def note_end(self, config):
        """As the unit's ExecStopPost does."""
        result = subprocess.run([service_case.NANOPLC, "note-end", config], capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stdout + result.stderr), (0, ""))

    def test_note_end_beside_a_service_does_nothing(self):
        config = self.stored_run()
        service = self.start(config)
        self.moves()
        with open(self.mark, "rb") as file:
            before = file.read()
        result = subprocess.run([service_case.NANOPLC, "note-end", config], capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stdout, result.stderr.count("\n")), (3, "", 1))
        self.assertIn("a service uses this store", result.stderr)
        with open(self.mark, "rb") as file:
            self.assertEqual(file.read(), before)
        self.assertEqual(self.end(service), 0)

    def test_a_power_cut_after_a_crash_is_still_a_crash(self):
        config = self.stored_run()
        self.crash(config)
        self.note_end(config)
        with open(self.mark, encoding="ascii") as file:
            state = file.read(7)
        self.write_mark(state)
        service, _ = self.expect_waits(config, "watchdog", "the last run did not end in order")
        self.assertEqual(self.end(service), 0)
        self.note_end(config)
        service, _ = self.expect_waits(config, "watchdog", "the last run did not end in order")
        self.ctl("run")
        self.moves()
        self.assertEqual(self.end(service), 0)
        self.note_end(config)
        self.start(config)
        self.moves()

    def test_a_crash_waits_through_orderly_starts(self):
        config = self.stored_run()
        self.crash(config)
        for _ in range(3):
            service, _ = self.expect_waits(config, "watchdog", "the last run did not end in order")
            self.assertEqual(self.end(service), 0)
        service, _ = self.expect_waits(config, "watchdog", "the last run did not end in order")
        self.ctl("run")
        self.moves()
        self.assertEqual(self.end(service), 0)
        self.start(config)
        self.moves()

    def test_a_new_axis_waits_for_a_first_run(self):
        config = self.write(self.axis(table=self.table), are_new=True)
        for _ in range(2):
            service, status = self.expect_waits(config, "not started", "new here: waits for a first run command")
            self.assertTrue(status["waits_for_first_run"])
            self.assertEqual(self.end(service), 0)
        service = self.start(config)
        self.ctl("run")
        self.moves()
        self.assertFalse(self.ctl("status")["waits_for_first_run"])
        self.assertEqual(self.end(service), 0)
        self.start(config)
        self.moves()

    def test_what_was_lost_starts_no_configured_table(self):
        config = self.write(self.axis(table=self.table))
        self.assertEqual(self.end(self.start(config)), 0)
        shutil.rmtree(self.path("state"))
        service, _ = self.expect_waits(config, "not started", "new here")
        self.ctl("run")
        self.moves()
        self.assertEqual(self.end(service), 0)
        for page in range(16):
            self.erase(page * 2048)
        for _ in range(2):
            service, _ = self.expect_waits(config, "bad run mark", "nobody knows whether the last run ended in order")
            self.assertEqual(self.end(service), 0)

    def test_a_lost_folder_is_not_a_new_axis(self):
        config = self.stored_run()
        for _ in range(2):
            shutil.rmtree(self.path("state/x"))
            service, status = self.expect_waits(config, "not started", "x: its store was lost (it was in use since ")
            self.assertEqual((status["waits_for_first_run"], status["store_lost"], status["store_of_another_axis"]), (True, True, False))
            self.assertNotIn("new here", service.said())
            words = subprocess.run([service_case.NANOCTL, "--port", "unix:" + self.path("x"), "--patience", "2000", "status"],
                                   capture_output=True, text=True, check=True).stdout
            self.assertIn("\nLOST: the store that the axis had", words)
            self.ctl("reset")
            self.until_status(lambda status: status["store_lost"])
            self.ctl("upload", self.table, "--run")
            self.assertFalse(self.ctl("status")["store_lost"])
            self.assertEqual(self.end(service), 0)
        self.flip(self.path("state/commissioned.txt"), 7)
        shutil.rmtree(self.path("state/x"))
        service, status = self.expect_waits(config, "not started", "new here: waits for a first run command")
        self.assertIn("commissioned.txt: is damaged; which axes were in use before is not known", service.said())
        self.assertFalse(status["store_lost"])

    def test_another_axiss_store_waits(self):
        config = self.stored_run()
        os.rename(self.path("state/x"), self.path("state/y"))
        config = self.write(self.axis("y", port="unix:" + self.path("x")))
        service, status = self.expect_waits(config, "not started", "is the store of axis x")
        self.assertEqual((status["waits_for_first_run"], status["store_lost"], status["store_of_another_axis"]), (True, False, True))
        self.ctl("run")
        self.assertFalse(self.ctl("status")["store_of_another_axis"])
        self.moves()
        self.assertEqual(self.end(service), 0)
        self.start(config)
        self.moves()


class FullDisk(SmallDisk):
    def stored_run_inside(self):
        config = self.write(self.axis())
        service = self.start_inside(config)
        self.ctl("upload", "--only-store", self.table)
        self.assertEqual(self.end(service), 0, service.said())
        return config

    def test_a_crash_is_known(self):
        config = self.stored_run_inside()
        self.fill()
        for _ in range(2):
            service = self.start_inside(config)
            self.until_status(lambda status: status["state"] in ("running", "stopped"))
            self.end(service, signal.SIGKILL)
            self.pull_out()  # the killed one's exclusive use of the line outlives it, and only root gets round that
            self.plug_in()
        self.start_inside(config)
        status = self.ctl("status")
        self.assertEqual((status["state"], status["safe_reason"]), ("stopped", "watchdog"))

    def test_the_plant_reads_stops_and_is_told_what_was_not_kept(self):
        example = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "sequence", "examples", "cut_to_length.seq")
        cutter = self.path("cutter.bin")
        subprocess.run([service_case.SEQC, "build", example, "-o", cutter], check=True, stdout=subprocess.DEVNULL)
        config = self.write(self.axis(), service='[modbus]\nlisten = "tcp:127.0.0.1:0"\n')
        service = self.start_inside(config)
        self.until(lambda: "Modbus: listens" in service.said(), service)
        self.ctl("upload", cutter, "--run")
        master = modbus_test.Master(modbus_test.port_of(service.said().partition("Modbus: listens")[2]))
        self.addCleanup(master.client.close)
        self.until(lambda: not master.inputs(210, 2).isError())
        self.until(lambda: master.status(1))  # the run goes on when the motor answers
        self.fill()
        self.assertFalse(master.write(0, 0, 0).isError())
        for number in range(1, 21):  # whatever room its own file still has
            changes = master.long(206)
            self.assertFalse(master.write(0, 34, number, 0, 0, 0, 0, 0, 1000 + number).isError())
            self.until(lambda number=number: master.words(41) == [number])  # on a busy machine after the answer
            self.assertTrue(master.status(1))
            result, = master.words(42)
            self.assertIn(result, (0, STORAGE_FAILED))
            self.assertEqual(master.long(206), changes + (result == 0), "what was not kept is not wanted")
        self.assertFalse(master.coil(1).isError())
        self.assertTrue(master.status(4))
        self.assertEqual(self.ctl("status")["safe_reason"], "stop command")
        os.remove(self.state + "/fill")
        self.assertEqual(master.order(34, 30) if not master.write(6, 0, 900).isError() else None, 0)
        self.assertEqual(master.long(210), 900)
        self.assertEqual(self.end(service), 0, service.said())

    def test_an_upload_of_the_panel_is_refused_as_long_as_its_names_have_no_room(self):
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        service = self.start_inside(self.write(self.axis(), service=f'[panel]\nlisten = "127.0.0.1:{port}"\n'))
        self.until(lambda: "token: " in service.said(), service)
        panel = Panel(port)
        self.addCleanup(panel.close)
        self.assertEqual(panel.ask("login", secret=re.search(r"token: (\S+)", service.said())[1])["result"], "done")
        tables = {}
        for places in (1024, 2048):
            with open(service_case.MENDING, encoding="utf-8") as file:
                source = self.put(f"{places}.seq", file.read().replace("2048", str(places)))
            subprocess.run([service_case.SEQC, "build", source, "-o", self.path(f"{places}.bin")], check=True, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)
            with open(self.path(f"{places}.bin"), "rb") as table, open(self.path(f"{places}.sym"), encoding="utf-8") as names:
                tables[places] = {"table": base64.b64encode(table.read()).decode(), "activate": True}, json.load(names)

        def upload(places, with_names=True):
            table, names = tables[places]
            return panel.ask("upload", **table, **({"symbols": names} if with_names else {}))

        def kept():
            with open(self.state + "/x/names.sym", encoding="utf-8") as file:
                return json.load(file)["table"]["crc32"], self.ctl("status")["table_crc32"]

        self.assertEqual(upload(1024)["result"], "done")
        before = kept()
        self.fill()
        answer = upload(2048)
        self.assertEqual(answer["result"], "refused")
        self.assertRegex(answer["text"], "^the names cannot be kept: .*/x/names.sym.new: No space left on device; nothing was stored; make room ")
        self.assertEqual(kept(), before)
        self.assertEqual(sorted(os.listdir(self.state + "/x")), ["names.sym", "running", "store.bin"])
        self.assertEqual(upload(2048, with_names=False)["result"], "done", "the store has its room")
        os.remove(self.state + "/fill")
        self.assertEqual(upload(1024)["result"], "done")
        self.assertEqual(kept(), before)
        self.assertEqual(self.end(service), 0, service.said())

    def test_an_orderly_end_is_known(self):
        config = self.stored_run_inside()
        self.fill()
        for _ in range(2):
            service = self.start_inside(config)
            self.moves()
            self.assertEqual(self.end(service), 0)

    def test_without_room_for_the_mark_nothing_runs(self):
        config = self.stored_run_inside()
        os.remove(self.mark)
        self.fill()
        service = self.start_inside(config)
        self.until(lambda: "running: cannot be written: No space left on device" in service.said(), service)
        status = self.ctl("status")
        self.assertEqual((status["state"], status["safe_reason"], status["enabled"]), ("stopped", "bad run mark", False))
        self.expect_refuses()
        self.end(service)
        os.remove(self.state + "/fill")
        service = self.start_inside(config)
        self.assertEqual(self.ctl("status")["safe_reason"], "bad run mark", "what was lost is still lost")
        self.ctl("run")
        self.moves()
        self.end(service)
        self.start_inside(config)
        self.moves()


class Settings(Stored):
    KEPT = ("autostart=0", "enable_input=3", "safe_outputs=5")

    def kept(self):
        config = self.stored_run("[axis.settings]\nsafe_outputs = 2\n")
        service = self.start(config)
        self.moves()
        self.ctl("stop")
        self.ctl("settings", "set", *self.KEPT, "--keep")
        self.end(service)
        return config

    def expect_blocked(self, config, outputs):
        service, status = self.expect_waits(config, "bad settings", "the stored settings are damaged or gone")
        self.assertEqual((status["settings_damaged"], status["enabled"], status["outputs"]), (True, False, outputs))
        self.expect_refuses()
        return service

    def test_a_flipped_bit_starts_nothing(self):
        config = self.kept()
        self.flip(self.store, SETTINGS[0] + 60)
        service = self.expect_blocked(config, 2)
        self.ctl("reset")
        self.until_status(lambda status: status["safe_reason"] == "bad settings")
        self.expect_refuses()
        self.ctl("settings", "set", "safe_outputs=5", "--keep")
        status = self.ctl("status")
        self.assertEqual((status["settings_damaged"], status["outputs"]), (False, 5))
        self.ctl("run")
        self.moves()
        self.end(service)

    def test_the_older_ones_do_not_start_it_either(self):
        config = self.kept()
        service = self.start(config)
        self.ctl("settings", "set", "safe_outputs=4", "--keep")
        self.end(service)
        self.flip(self.store, SETTINGS[1] + 60)
        self.expect_blocked(config, 5)

    def test_a_lost_block_of_the_only_ones(self):
        for byte in (0xFF, 0x00):
            with self.subTest(byte=byte):
                config = self.kept()
                self.erase(SETTINGS[0], byte)
                self.end(self.expect_blocked(config, 2))
                shutil.rmtree(self.path("state"))

    def test_a_store_that_is_gone(self):
        config = self.kept()
        os.remove(self.store)
        for _ in range(2):
            service = self.expect_blocked(config, 2)
            self.assertIn(self.store + " is missing", self.said_first)
            self.assertTrue(self.ctl("status")["table_damaged"])
            self.end(service)
        service = self.expect_blocked(config, 2)
        self.until_status(lambda status: status["link"] in ("up", "not acknowledged"))
        self.ctl("upload", self.table)
        self.ctl("settings", "set", "safe_outputs=5", "--keep")
        self.ctl("run")
        self.moves()
        self.end(service)
        self.start(config)
        self.moves()

    def expect_waits(self, config, reason, said):
        service, status = super().expect_waits(config, reason, said)
        self.said_first = getattr(self, "said_first", service.said())
        return service, status


class Both(Stored):
    def test_kept_settings_do_not_mend_the_mark(self):
        config = self.stored_run()
        service = self.start(config)
        self.ctl("stop")
        self.ctl("settings", "set", "safe_outputs=5", "--keep")
        self.end(service)
        self.flip(self.store, SETTINGS[0] + 60)
        os.remove(self.mark)
        os.makedirs(self.mark + "/in_the_way")
        self.expect_waits(config, "bad run mark", "the stored settings are damaged")
        self.ctl("reset")
        self.until_status(lambda status: status["uptime_ms"] < 2000 and status["safe_reason"] == "bad run mark")
        self.ctl("settings", "set", "safe_outputs=5", "--keep")
        self.expect_refuses()


class Tables(Stored):
    def test_an_older_one_does_not_stand_in_silently(self):
        config = self.stored_run()
        older = self.ctl_once(config)
        with open(self.path("other.bin"), "wb") as file:  # one term and the end term
            file.write(bytes([0xC0, 1, 1, 1, 0x80, 5, 0, 0, 0x3F, 0, 0, 0, 0, 0, 0, 0]))
        service = self.start(config)
        self.ctl("upload", "--only-store", self.path("other.bin"))
        self.end(service)
        self.erase(TABLES[1])
        _, status = self.expect_waits(config, "bad table", "damaged")
        self.assertTrue(status["table_damaged"])
        self.assertEqual(status["table_crc32"], older)

    def ctl_once(self, config):
        service = self.start(config)
        crc = self.ctl("status")["table_crc32"]
        self.end(service)
        return crc

    def test_the_only_one_is_lost(self):
        config = self.stored_run()
        self.erase(TABLES[0])
        _, status = self.expect_waits(config, "bad table", "damaged")
        self.assertTrue(status["table_damaged"])
        self.ctl("run", exit_code=1)


if __name__ == "__main__":
    (service_case.NANOPLC, service_case.MACSIM, service_case.NANOCTL, service_case.MACREG, service_case.SEQC,
     service_case.MENDING) = sys.argv[1:7]
    unittest.main(argv=sys.argv[:1] + sys.argv[7:])
