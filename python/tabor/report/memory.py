"""How the C library of this process deals with memory that is free again."""

_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3  # of <malloc.h>
LARGE = 8 << 20  # bytes


def give_large_blocks_back():
    """Maps and pictures that are not needed any more leave the process at once; glibc would hold several for later."""
    try:
        import ctypes

        mallopt = ctypes.CDLL(None).mallopt
    except (ImportError, OSError, AttributeError):  # another C library, or no way to call it
        return
    mallopt(_MMAP_THRESHOLD, LARGE)
    mallopt(_TRIM_THRESHOLD, LARGE)
