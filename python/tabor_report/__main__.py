import sys

from tabor_report.cli import main

sys.stdout.reconfigure(errors="surrogateescape")  # names of files are bytes
sys.exit(main(sys.argv[1:]))
