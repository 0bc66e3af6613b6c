class Unreadable(Exception):
    """What is wrong with the input, in words for the user."""
