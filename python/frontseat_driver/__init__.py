"""Programs for people around the driver; the messages are beside it, in frontseat_driver.msg."""
