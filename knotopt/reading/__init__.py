"""What KNOT means: a file each for the forms in which people bring knots.

`knot.read_knot` takes a source (an argument, a file, standard input, a Python value), and `forms`
lists the forms in the order in which they are tried.
"""
