"""A robot that keeps its own state: each step adds the action. It falls silent after so many steps as its parameter says,
and starts 100 farther for each episode whose end it was told."""
import json
import sys

ends = 0
for text in sys.stdin:
    message = json.loads(text)
    if "rehearse" in message:
        answer = {"rehearse": 1, "messages": ["reset", "step", "end"]}
    elif "reset" in message:
        state, left = [x + 100 * ends for x in message["reset"]["state"]], message["reset"]["parameters"][0]
        answer = {"state": state, "truth": state}
    elif "end" in message:
        ends += 1
        answer = {"end": True}
    else:
        left -= 1
        if left < 0:
            sys.exit("the battery is empty")
        state = [x + message["step"]["action"][0] for x in state]
        answer = {"state": [x + 0.5 for x in state], "truth": state}
    print(json.dumps(answer), flush=True)
