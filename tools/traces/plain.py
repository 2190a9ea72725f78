"""Texts of others, made harmless for a terminal and for a picture: as hal/host/printable.cpp has it."""


def plain(text):
    """Each control character, and each byte of a file's name that is no UTF-8, becomes '?'."""
    def is_harmless(character):
        code = ord(character)
        return character == "\t" or (0x20 <= code < 0x7F) or (code >= 0xA0 and not 0xD800 <= code < 0xE000)
    return "".join(character if is_harmless(character) else "?" for character in str(text))
