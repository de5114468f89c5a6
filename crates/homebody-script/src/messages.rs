use homebody_core::problem::{Advice, counted};

homebody_core::messages! {
    /// Problems with scripts, before a run or during it.
    pub enum ScriptMessage in "script" {
        /// The text does not follow the syntax of Rhai, the language of scripts.
        Syntax { what: String, help: Option<String> } error "syntax" ("the script has a syntax error: {what}")
            advice (help.clone());
        /// Homebody calls the functions of a script when a resident has something to decide. Statements outside of them would never run:
        ///
        /// ```rhai
        /// fn next(around) { wait(60) }
        /// ```
        OutsideFunction error "outside-function" ("this statement is outside of every function")
            hint ("move it into fn next(around); a script has functions and constants only");
        /// Functions see the constants of a script only if their names begin with a capital letter.
        ConstantName { name: String } error "constant-name" ("the constant {name} does not begin with a capital letter")
            hint ("write the name in capital letters");
        /// Homebody calls `next` whenever the resident has nothing left to do. Every script needs it.
        NoNext { form: String } error "no-next" ("the script has no function next")
            hint ("write {form} {{ .. }}, which returns a step such as wait(60)");
        /// Homebody calls this function with a fixed number of values.
        Parameters { function: String, parameters: usize, form: String } error "parameters" ("the function {function} cannot have {parameters}", parameters = counted(*parameters, "parameter", "parameters"))
            hint ("write {form}");
        /// A variable ends with its function. `this` keeps values from one decision to the next.
        UnknownVariable { name: String, near: Option<String> } error "unknown-variable" ("there is no variable {name}")
            advice (Some(match near {
                Some(near) => format!("did you mean {near}?"),
                None => "give it a value with let; write this.name for a value that lasts until the next decision".into(),
            }));
        /// `around` is what the resident sees at the moment of a decision. The reference of scripts lists its properties.
        UnknownProperty { name: String, help: String } error "unknown-property" ("there is no property around.{name}")
            hint ("{help}");
        /// The name is not a function of the script, of Homebody or of Rhai. Some functions of Rhai, such as `eval`, are left out.
        UnknownFunction { name: String, help: Option<String> } error "unknown-function" ("there is no function {name}")
            advice (help.clone());
        /// This word of Homebody has another number of values.
        ValueCount { word: String, values: usize, forms: Vec<String> } error "value-count" ("{word} does not take {values}", values = counted(*values, "value", "values"))
            hint ("write {forms}", forms = forms.join(" or "));
        /// A constant or a literal value has a type that this word does not take.
        ValueType { word: String, parameter: String, wanted: String, found: String } error "value-type" ("{word} needs {wanted} as {parameter}, and this is {found}");
        /// Steps take time, so that the simulation can continue.
        Duration { duration_s: f64 } error "duration" ("a step cannot last {duration_s} seconds")
            hint ("write a number of seconds above 0");
        /// Scripts name places, furniture, things and rooms as `home.json` does.
        UnknownName { noun: String, name: String, help: Advice } error "unknown-name" ("the home has no {noun} {name:?}")
            advice (Some(help.clone()));
        /// The manner decides how much a resident moves while waiting. The reference of scripts lists the manners.
        UnknownManner { name: String, help: Advice } error "unknown-manner" ("there is no manner {name:?}")
            advice (Some(help.clone()));
        /// Only pieces of furniture that a resident can get on or into have a place to sit or lie.
        NotASeat { verb: String, place: String } error "not-a-seat" ("a resident cannot {verb} at {place:?}")
            hint ("name a piece of furniture that is \"enterable\", or use go(..) to stand next to this one");
        /// Each name of a stream is a new source of random numbers. The limit is our choice.
        TooManyStreams { most: usize } error "too-many-streams" ("the script draws random numbers from more than {most} streams")
            hint ("name streams by their purpose, not by numbers");
        /// This word takes numbers only.
        NotANumber { value: String, found: String } error "not-a-number" ("{value} must be a number, and this is {found}");
        /// A division by zero and similar calculations have no finite result.
        NotFinite { value: String, number: String } error "not-finite" ("{value} must be finite, and this is {number}");
        /// `step(degrees, metres)` goes forward in a direction.
        NegativeStep { distance_m: f64 } error "negative-step" ("step(..) cannot go {distance_m} metres")
            hint ("turn round instead: add 180 degrees");
        /// Homebody asks the script for the next step, and the script returned another value.
        NotAStep { found: String } error "not-a-step" ("the script returned {found}, but Homebody expects a step")
            hint ("return a step, such as wait(60), or a list of steps");
        /// A list without elements has nothing to choose.
        EmptyList error "empty-list" ("pick(..) cannot choose from an empty list")
            hint ("check the length of the list first");
        /// Words that look around, and random numbers, work only while Homebody asks the script for a decision.
        NotAsked error "not-asked" ("this word works only in functions that Homebody calls");
        /// The script decides again and again, and none of its steps takes time, so the run would not continue.
        NoTime { most: u32 } error "no-time" ("the script made {most} decisions in a row that take no time")
            hint ("return a step that takes time, such as wait(60)");
        /// All decisions of an hour together have a limit, so that one script cannot hold up a run. The limit is our choice.
        SlowHour { most: u64 } error "slow-hour" ("the script takes more than {most} operations in one hour of the run")
            hint ("let the script decide less often, or do less work for each decision");
        /// A single decision has a limit, so that an endless loop ends with a message. The limit is our choice.
        SlowDecision { most: u64 } error "slow-decision" ("the script takes more than {most} operations for one decision")
            hint ("end the loop, or spread the work over several decisions");
        /// A function calls itself, directly or through others, and does not end.
        DeepCalls error "deep-calls" ("the functions of the script call each other too deeply")
            hint ("check that each function that calls itself stops after some calls");
        /// Homebody takes the steps of a script one after the other. The limit of waiting steps is our choice.
        TooManySteps { most: usize } error "too-many-steps" ("the script has returned too many steps: more than {most} are waiting")
            hint ("return the next steps only; decide on the rest later");
        /// The resident leaves or enters the home, and no door of it leads outside.
        NoFrontDoor error "no-front-door" ("the home has no front door")
            hint ("write \"outside\": true for one of the doors in home.json");
        /// Furniture or a closed door blocks every way to this place.
        NoWay { place: String } error "no-way" ("there is no way to {place:?}")
            hint ("check the way first, with around.can_reach(..)");
        /// At the beginning of a run, the script has to place the resident in the home.
        NoStart error "no-start" ("the script does not say where in the home the resident begins")
            hint ("return go(..) first: the run begins at that place");
        /// `begin` returns the values that the script remembers as `this`.
        NotAMap error "not-a-map" ("begin() must return a map")
            hint ("return a map, such as #{{ rounds: 0 }}");
        /// A value was read from `this` before the script stored it there.
        NotRemembered { name: String } error "not-remembered" ("the script reads this.{name}, but has stored no value there")
            hint ("give it a value in fn begin(), such as #{{ rounds: 0 }}");
        /// An operation got the empty value `()`, usually because nothing was remembered under a name yet.
        MissingValue { signature: String } error "missing-value" ("a value is missing in {signature}, where () stands for the empty value")
            hint ("give the remembered value a first value in fn begin(), such as #{{ rounds: 0 }}");
        /// The script ended itself with `throw`, or Rhai stopped it for the given reason.
        Failed { what: String } error "failed" ("the script failed: {what}");
    }
}
