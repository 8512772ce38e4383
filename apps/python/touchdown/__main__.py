import sys

from touchdown.experiment import main

sys.exit(main())
