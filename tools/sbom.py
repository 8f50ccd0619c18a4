#!/usr/bin/env python3
"""The bill of materials of a folder of scripts/package tar as SPDX 2.3, on standard output: the program and the packages of
Debian that its libraries are of."""
import hashlib
import json
import pathlib
import sys
import time

folder = pathlib.Path(sys.argv[1])
version = folder.name.split("-")[1]
documents = folder / "share" / "doc" / "clackers"


def package(name, version, licence):
    return {"SPDXID": f"SPDXRef-{name.replace('+', '-')}", "name": name, "versionInfo": version, "downloadLocation": "NOASSERTION",
            "filesAnalyzed": False, "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": "NOASSERTION"}


def checksum(path):
    return {"algorithm": "SHA256", "checksumValue": hashlib.sha256(path.read_bytes()).hexdigest()}


libraries = [package(*line.split()[:2], "NOASSERTION") for line in (documents / "libraries.txt").read_text().splitlines()]
clackers = {**package("clackers", version, "Apache-2.0"), "checksums": [checksum(folder / "bin" / "clackers")]}
identifiers = [each["SPDXID"] for each in libraries]
json.dump({
    "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": folder.name,
    "documentNamespace": f"urn:clackers:{folder.name}:{clackers['checksums'][0]['checksumValue'][:16]}",
    "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()), "creators": ["Tool: clackers-sbom"]},
    "packages": [clackers, *libraries],
    "relationships": [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": "SPDXRef-clackers"}] +
                     [{"spdxElementId": "SPDXRef-clackers", "relationshipType": "DYNAMIC_LINK", "relatedSpdxElement": each} for each in identifiers],
}, sys.stdout, indent=1)
