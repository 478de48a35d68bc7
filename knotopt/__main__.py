"""`python -m knotopt` is the command `knotopt`."""

from knotopt.cli.app import main

if __name__ == "__main__":
    main()
