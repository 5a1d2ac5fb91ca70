import sys

from tabor_report.cli import main

sys.exit(main(sys.argv[1:]))
