#!/usr/bin/env python3
"""The image check must find each kind of symbol, and leave innocent ones alone."""

import unittest

import mcu_image


class McuImage(unittest.TestCase):
    def test_banned(self):
        for kind, symbols in {
            "heap": ["malloc", "_malloc_r", "_free_r", "_sbrk", "_Znwj", "_Znaj", "_ZnwjRKSt9nothrow_t", "_ZdlPv", "_ZdlPvj"],
            "exceptions": ["__cxa_throw", "__cxa_allocate_exception", "_Unwind_Resume", "__gxx_personality_v0"],
            "run-time type information": ["__dynamic_cast", "_ZTIN4nplc5ports5ClockE"],
            "floating point": [
                "__aeabi_dadd", "__aeabi_dsub", "__aeabi_drsub", "__aeabi_dmul", "__aeabi_ddiv", "__aeabi_dcmplt",
                "__aeabi_d2iz", "__aeabi_d2uiz", "__aeabi_d2lz", "__aeabi_d2f", "__aeabi_fadd", "__aeabi_fdiv",
                "__aeabi_f2iz", "__aeabi_f2d", "__aeabi_i2d", "__aeabi_ui2d", "__aeabi_l2d", "__aeabi_ul2d",
                "__aeabi_i2f", "__aeabi_ui2f",
            ],
            "64-bit division": ["__aeabi_ldivmod", "__aeabi_uldivmod", "__udivmoddi4"],
            "guarded statics": ["__cxa_guard_acquire"],
            "input and output": ["printf", "_printf_r", "_write_r"],
        }.items():
            for symbol in symbols:
                self.assertEqual(list(mcu_image.findings_in({symbol})), [f"{kind}: {symbol}"])

    def test_innocent(self):
        innocent = {
            "memcpy", "memset", "__aeabi_uidiv", "__aeabi_lmul", "__aeabi_llsl", "__cxa_pure_virtual", "__aeabi_atexit",
            "_ZN4nplc9sequencer6decodeESt4spanIKhLj8EE", "_Z12run_firmwarev", "reset_handler", "vectors",
        }
        self.assertEqual(list(mcu_image.findings_in(innocent)), [])


if __name__ == "__main__":
    unittest.main()
