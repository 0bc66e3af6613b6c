"""Three network namespaces on one computer: vehicle - backseat - topside."""

import os
import subprocess


def run(*command):
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


class Namespace:
    """One computer. Its interfaces are ends of cables."""

    def __init__(self, name):
        self.name = name
        self.folder = "/etc/netns/" + name

    def add(self):
        run("ip", "netns", "add", self.name)
        self.ip("link", "set", "lo", "up")

    def ip(self, *arguments):
        run("ip", "-n", self.name, *arguments)

    def command(self, *command):
        """That command, on this computer."""
        return ["ip", "netns", "exec", self.name] + list(command)

    def small_buffers(self):
        """For connections made from now on: a peer that does not read is noticed at once."""
        for kind in ("rmem", "wmem"):
            run(*self.command("sysctl", "-qw", "net.ipv4.tcp_%s=4096 4096 4096" % kind))

    def hosts(self, **addresses):
        """What names mean here, for programs started after the first call."""
        os.makedirs(self.folder, exist_ok=True)
        text = "127.0.0.1 localhost\n" + "".join("%s %s\n" % (address, name)
                                                 for name, address in addresses.items())
        # In place, since running programs have this very file mounted.
        with open(self.folder + "/hosts", "w", encoding="ascii") as hosts:
            hosts.write(text)

    def remove(self):
        run("ip", "netns", "del", self.name)
        if os.path.isdir(self.folder):
            os.remove(self.folder + "/hosts")
            os.rmdir(self.folder)


class Cable:
    """Between two computers; `ends` are (namespace, interface, address)."""

    def __init__(self, *ends):
        self.ends = ends

    def plug(self):
        (one, one_interface, _), (other, other_interface, _) = self.ends
        run("ip", "-n", one.name, "link", "add", one_interface, "type", "veth", "peer", "name",
            other_interface, "netns", other.name)
        for namespace, interface, address in self.ends:
            namespace.ip("address", "add", address + "/24", "dev", interface)
            namespace.ip("link", "set", interface, "up")

    def set(self, number, *state):
        """The link state of one end."""
        namespace, interface, _ = self.ends[number]
        namespace.ip("link", "set", interface, *state)

    def both(self, *state):
        for number in range(2):
            self.set(number, *state)


VEHICLE, VEHICLE_MOVED = "10.77.1.2", "10.77.1.3"
BACKSEAT, BACKSEAT_MOVED, BACKSEAT_UP = "10.77.1.1", "10.77.1.9", "10.77.2.1"
TOPSIDE = "10.77.2.2"


class Network:
    """vehicle - backseat - topside, by a number that tells it from others on this computer."""

    def __init__(self, number):
        self.vehicle, self.backseat, self.topside = self.all = [
            Namespace("%s-%s" % (name, number)) for name in ("vehicle", "backseat", "topside")]
        self.cable = Cable((self.vehicle, "eth0", VEHICLE), (self.backseat, "eth0", BACKSEAT))
        self.tether = Cable((self.backseat, "eth1", BACKSEAT_UP), (self.topside, "eth0", TOPSIDE))

    def add(self):
        for namespace in self.all:
            namespace.add()
        self.cable.plug()
        self.tether.plug()
        self.backseat.hosts(vehicle=VEHICLE)

    def remove(self):
        for namespace in self.all:
            namespace.remove()
