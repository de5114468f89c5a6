"""Serves a model with the part of OpenAI's chat interface that Homebody uses.

Usage: serve.py MODEL.gguf PORT
"""

import json
import sys
from http.server import BaseHTTPRequestHandler, HTTPServer

from llama_cpp_py_sync import Llama

# The card, a home and a short text have about 4,000 tokens, an answer 1,000.
CONTEXT_TOKENS = 8_192
MOST_ANSWER_TOKENS = 1_000

NAME = "small"


class Chat(BaseHTTPRequestHandler):
    model: Llama

    def do_GET(self) -> None:
        found = self.path == "/v1/models"
        self.reply(200 if found else 404, {"data": [{"id": NAME}]} if found else {"error": "no such path"})

    def do_POST(self) -> None:
        asked = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        try:
            answer = self.model.create_chat_completion(
                asked["messages"],
                max_tokens=MOST_ANSWER_TOKENS,
                temperature=asked.get("temperature", 0.7),
                response_format=asked.get("response_format"),
                seed=1,
            )
        except ValueError as error:
            return self.reply(400, {"error": {"message": str(error)}})
        self.reply(200, answer)

    def reply(self, status: int, body: object) -> None:
        text = json.dumps(body).encode()
        self.send_response(status)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(text)))
        self.end_headers()
        self.wfile.write(text)


def main() -> None:
    path, port = sys.argv[1:]
    Chat.model = Llama(path, n_ctx=CONTEXT_TOKENS)
    print(f"serving {path} on port {port}", flush=True)
    HTTPServer(("127.0.0.1", int(port)), Chat).serve_forever()


if __name__ == "__main__":
    main()
