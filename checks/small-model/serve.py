"""Serves a model with the part of OpenAI's chat interface that Homebody uses.

Usage: serve.py MODEL.gguf PORT
"""

import json
import sys
import tempfile
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path

from gpt4all import GPT4All

# The card, a home and a short text have about 4,000 tokens.
CONTEXT_TOKENS = 8_192
MOST_ANSWER_TOKENS = 600

NAME = "small"

# This llama.cpp is older than the model, and reads it by the name of a tokenizer with the same rules.
NEW_NAME, OLD_NAME = b"\x06\0\0\0\0\0\0\0smollm", b"\x06\0\0\0\0\0\0\0refact"


class Chat(BaseHTTPRequestHandler):
    model: GPT4All

    def do_GET(self) -> None:
        found = self.path == "/v1/models"
        self.reply(200 if found else 404, {"data": [{"id": NAME}]} if found else {"error": "no such path"})

    def do_POST(self) -> None:
        asked = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        if "response_format" in asked:
            return self.reply(400, {"error": {"message": "response_format is not supported"}})
        turns = [f"<|im_start|>{message['role']}\n{message['content']}<|im_end|>\n" for message in asked["messages"]]
        prompt = "".join(turns) + "<|im_start|>assistant\n"
        answer = self.model.generate(prompt, max_tokens=MOST_ANSWER_TOKENS, temp=0, n_batch=128)
        self.reply(200, {"choices": [{"message": {"role": "assistant", "content": answer}}]})

    def reply(self, status: int, body: object) -> None:
        text = json.dumps(body).encode()
        self.send_response(status)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(text)))
        self.end_headers()
        self.wfile.write(text)


def main() -> None:
    path, port = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        readable = Path(folder) / "small.gguf"
        readable.write_bytes(Path(path).read_bytes().replace(NEW_NAME, OLD_NAME))
        Chat.model = GPT4All(readable.name, model_path=folder, allow_download=False, n_ctx=CONTEXT_TOKENS, device="cpu")
    print(f"serving {path} on port {port}", flush=True)
    HTTPServer(("127.0.0.1", int(port)), Chat).serve_forever()


if __name__ == "__main__":
    main()
