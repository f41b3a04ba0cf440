"""Certificates for a lab and its clients: made, read and checked with `cryptography`.

Keys are EC P-256, which rustls (zenoh), browsers and Unity take alike. Certificates follow RFC
5280: the lab's may only serve, a client's may only connect, neither may sign others.
"""

from __future__ import annotations

import ipaddress
import os
import re
from dataclasses import dataclass
from datetime import datetime, timedelta, timezone
from pathlib import Path

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID, ObjectIdentifier

from mrlab_ros.adapters.keys.diagnostics import (
    CERTIFICATE_EARLY,
    CERTIFICATE_EXPIRED,
    KEY_FILE_UNREADABLE,
    NO_CERTIFICATE,
    NO_EC_KEY,
    NO_HOST,
    NO_KEY_FILE,
    NO_PRIVATE_KEY,
    OTHER_AUTHORITY,
    OTHER_KEY,
)
from mrlab_ros.core.base.errors import BadInput

# A client whose clock is late by less accepts a new certificate.
SLACK = timedelta(hours=1)
# Host names as in RFC 1123; the last part is no number, or it would be an address.
LONGEST_HOST = 253
LABEL = r"(?!-)[A-Za-z0-9-]{1,63}(?<!-)"
HOST = re.compile(rf"(?:{LABEL}\.)*(?!\d+$){LABEL}")


@dataclass(frozen=True)
class Signed:
    """A certificate and its private key."""

    certificate: x509.Certificate
    key: ec.EllipticCurvePrivateKey

    @property
    def certificate_pem(self) -> bytes:
        return self.certificate.public_bytes(serialization.Encoding.PEM)

    @property
    def key_pem(self) -> bytes:
        return self.key.private_bytes(
            serialization.Encoding.PEM,
            serialization.PrivateFormat.PKCS8,
            serialization.NoEncryption(),
        )


def authority(common_name: str, now: datetime, lifetime: timedelta) -> Signed:
    """Make a certificate authority that signs certificates of clients and servers only."""
    key = ec.generate_private_key(ec.SECP256R1())
    name = _name(common_name)
    builder = _builder(name, name, key, key.public_key(), now, lifetime)
    builder = builder.add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
    builder = builder.add_extension(_usage(signs_certificates=True), critical=True)
    return Signed(builder.sign(key, hashes.SHA256()), key)


def server(
    issuer: Signed, common_name: str, hosts: list[str], now: datetime, lifetime: timedelta
) -> Signed:
    """Make a certificate for a program that listens as any of `hosts` (names and addresses)."""
    names = x509.SubjectAlternativeName([_host(host) for host in hosts])
    return _leaf(issuer, common_name, ExtendedKeyUsageOID.SERVER_AUTH, names, now, lifetime)


def client(issuer: Signed, common_name: str, now: datetime, lifetime: timedelta) -> Signed:
    """Make a certificate for a program that connects; `common_name` says whose it is."""
    return _leaf(issuer, common_name, ExtendedKeyUsageOID.CLIENT_AUTH, None, now, lifetime)


def read(certificate: Path, key: Path) -> Signed:
    """Read a certificate and its key; raise BadInput where they are missing or no pair."""
    found = read_certificate(certificate)
    try:
        secret = serialization.load_pem_private_key(_bytes(key), None)
    except (ValueError, TypeError) as error:
        raise BadInput(NO_PRIVATE_KEY(path=str(key), why=str(error))) from error
    if not isinstance(secret, ec.EllipticCurvePrivateKey):
        raise BadInput(NO_EC_KEY(path=str(key), found=type(secret).__name__))
    if secret.public_key() != found.public_key():
        raise BadInput(OTHER_KEY(path=str(key), certificate=str(certificate)))
    return Signed(found, secret)


def read_certificate(path: Path) -> x509.Certificate:
    """Read a certificate; raise BadInput where there is none."""
    try:
        return x509.load_pem_x509_certificate(_bytes(path))
    except ValueError as error:
        raise BadInput(NO_CERTIFICATE(path=str(path), why=str(error))) from error


def check(found: x509.Certificate, issuer: x509.Certificate, now: datetime, path: Path) -> None:
    """Raise BadInput where the certificate of `path` is not valid now, or not of this issuer."""
    begin, end = validity(found)
    if now > end:
        raise BadInput(CERTIFICATE_EXPIRED(path=str(path), end=_instant(end)))
    if now < begin:
        raise BadInput(CERTIFICATE_EARLY(path=str(path), begin=_instant(begin), now=_instant(now)))
    try:
        found.verify_directly_issued_by(issuer)
    except Exception as error:  # the signature's error has no class of its own
        signer, authority = found.issuer.rfc4514_string(), issuer.subject.rfc4514_string()
        raise BadInput(
            OTHER_AUTHORITY(path=str(path), signer=signer, authority=authority)
        ) from error


def _instant(at: datetime) -> str:
    return f"{at:%Y-%m-%d %H:%M}"


def validity(found: x509.Certificate) -> tuple[datetime, datetime]:
    """Return when a certificate begins and ends to be valid, in UTC."""
    try:
        return found.not_valid_before_utc, found.not_valid_after_utc
    except AttributeError:  # before cryptography 42, which Ubuntu 24.04 does not have yet
        begin, end = found.not_valid_before, found.not_valid_after
        return begin.replace(tzinfo=timezone.utc), end.replace(tzinfo=timezone.utc)


def hosts(found: x509.Certificate) -> list[str]:
    """Return the names and addresses for which a certificate may serve."""
    names = found.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    return [str(name.value) for name in names]


def common_name(found: x509.Certificate) -> str:
    """Return whose certificate it is."""
    (name,) = found.subject.get_attributes_for_oid(NameOID.COMMON_NAME)
    return str(name.value)


def fingerprint(found: x509.Certificate) -> str:
    """Return the SHA-256 fingerprint of a certificate as browsers show it, in two lines."""
    pairs = [f"{byte:02X}" for byte in found.fingerprint(hashes.SHA256())]
    return "\n".join(":".join(pairs[i : i + 16]) for i in (0, 16))


def _bytes(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except FileNotFoundError as error:
        raise BadInput(NO_KEY_FILE(path=str(path))) from error
    except OSError as error:
        why = os.strerror(error.errno or 0)
        raise BadInput(KEY_FILE_UNREADABLE(path=str(path), why=why)) from error


def is_host(host: str) -> bool:
    """Return whether a certificate can name `host`."""
    try:
        _host(host)
    except BadInput:
        return False
    return True


def _host(host: str) -> x509.GeneralName:
    try:
        return x509.IPAddress(ipaddress.ip_address(host))
    except ValueError:
        pass
    if len(host) > LONGEST_HOST or not HOST.fullmatch(host):
        raise BadInput(NO_HOST(host=host))
    return x509.DNSName(host)


def _leaf(
    issuer: Signed,
    common_name: str,
    purpose: ObjectIdentifier,
    names: x509.SubjectAlternativeName | None,
    now: datetime,
    lifetime: timedelta,
) -> Signed:
    key = ec.generate_private_key(ec.SECP256R1())
    subject = _name(common_name)
    # Nothing outlives what signed it.
    lifetime = min(lifetime, validity(issuer.certificate)[1] - now)
    builder = _builder(
        subject, issuer.certificate.subject, key, issuer.key.public_key(), now, lifetime
    )
    builder = builder.add_extension(x509.BasicConstraints(ca=False, path_length=None), True)
    builder = builder.add_extension(_usage(signs_certificates=False), critical=True)
    builder = builder.add_extension(x509.ExtendedKeyUsage([purpose]), critical=False)
    if names is not None:
        builder = builder.add_extension(names, critical=False)
    return Signed(builder.sign(issuer.key, hashes.SHA256()), key)


def _builder(
    subject: x509.Name,
    issuer: x509.Name,
    key: ec.EllipticCurvePrivateKey,
    issuer_key: ec.EllipticCurvePublicKey,
    now: datetime,
    lifetime: timedelta,
) -> x509.CertificateBuilder:
    authority_key = x509.AuthorityKeyIdentifier.from_issuer_public_key(issuer_key)
    return (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(issuer)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - SLACK)
        .not_valid_after(now + lifetime)
        .add_extension(x509.SubjectKeyIdentifier.from_public_key(key.public_key()), False)
        .add_extension(authority_key, critical=False)
    )


def _name(common_name: str) -> x509.Name:
    return x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, common_name)])


def _usage(*, signs_certificates: bool) -> x509.KeyUsage:
    return x509.KeyUsage(
        digital_signature=not signs_certificates,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        key_cert_sign=signs_certificates,
        crl_sign=signs_certificates,
        encipher_only=False,
        decipher_only=False,
    )
