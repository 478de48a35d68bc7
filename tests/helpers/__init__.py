"""What tests of several packages share: strategies, small inputs, and other ways to an answer.

What is set up and taken down again is a fixture, in the `conftest.py` of those that use it.
"""
