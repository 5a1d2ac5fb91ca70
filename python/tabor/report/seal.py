"""The last line of a file of a sweep's store: the digest of all bytes before it (docs/results.md)."""

import hashlib
import os

WORD = b"tabor-sha256 "
SIZE = len(WORD) + 64 + 1
_BLOCK = 1 << 20


def is_broken(path):
    """True if the file ends in a seal that is not of its bytes. Results that are no part of a store have none."""
    size = os.path.getsize(path) - SIZE
    if size < 0:
        return False
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        file.seek(size)
        line = file.read()
        if not line.startswith(WORD):
            return False
        file.seek(0)
        while size > 0:
            block = file.read(min(size, _BLOCK))
            if not block:
                return True
            digest.update(block)
            size -= len(block)
    return line != WORD + digest.hexdigest().encode() + b"\n"
