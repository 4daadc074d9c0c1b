"""A mail server for tests: takes what is sent to it and prints each mail as a line of JSON.

usage: smtp_sink.py [CERTIFICATE KEY USER PASSWORD]
With arguments it takes mail only after STARTTLS and a log-in. The first line is the port on which it listens.
"""
import asyncio
import email
import email.policy
import json
import ssl
import sys

from aiosmtpd.smtp import SMTP, AuthResult


class Printer:
    async def handle_DATA(self, server, session, envelope):
        raw = envelope.content
        mail = email.message_from_bytes(raw, policy=email.policy.default)
        print(json.dumps({
            "from": envelope.mail_from,
            "to": envelope.rcpt_tos,
            "headers": {name: str(value) for name, value in mail.items()},
            "defects": [str(defect) for defect in mail.defects],
            "longest_line": max(len(line) for line in raw.split(b"\r\n")),
            "bare_newlines": raw.replace(b"\r\n", b"").count(b"\n"),
            "text": mail.get_content(),
            "tls": session.ssl is not None,
        }), flush=True)
        return "250 taken"


def settings():
    if len(sys.argv) == 1:
        return {}
    certificate, key, user, password = sys.argv[1:]
    context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
    context.load_cert_chain(certificate, key)

    def check(server, session, envelope, mechanism, data):
        right = data.login == user.encode() and data.password == password.encode()
        return AuthResult(success=right, handled=False)

    return {"tls_context": context, "require_starttls": True, "auth_required": True, "authenticator": check}


async def main():
    loop = asyncio.get_running_loop()
    options = settings()
    server = await loop.create_server(lambda: SMTP(Printer(), hostname="sink", **options), "127.0.0.1", 0)
    print(server.sockets[0].getsockname()[1], flush=True)
    await server.serve_forever()


asyncio.run(main())
