//! The engine of all scripts: the language, the words and the limits.
//!
//! Scripts have no clock, no files, no other scripts and only named streams as a source of chance. Sines and powers of the
//! platform are left out, because machines differ in their last digits. Everything that a script can fill or spend is
//! limited.

use crate::messages::ScriptMessage;
use crate::moment::{Around, ScriptError, ScriptMoment, manner, number, span, type_name, wrong};
use crate::step::ScriptStep;
use crate::vocabulary;
use homebody_core::geometry::Point;
use homebody_core::posture::Posture;
use homebody_walk::WanderStyle;
use rhai::packages::{
    ArithmeticPackage, BasicArrayPackage, BasicFnPackage, BasicIteratorPackage, BasicMapPackage, BasicStringPackage,
    LogicPackage, MoreStringPackage, Package,
};
use rhai::{Array, Dynamic, Engine, NativeCallContext, OptimizationLevel, Token};
use std::cell::Cell;
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// Largest number of operations of a decision (our choice): a long one takes some thousands.
pub const MOST_OPERATIONS: u64 = 50_000;

// Largest depths and sizes (our choice): people write far smaller ones by hand.
const DEEPEST_CALLS: usize = 32;
const DEEPEST_EXPRESSIONS: usize = 64;
const LONGEST_TEXT: usize = 10_000;
const LONGEST_LIST: usize = 1_000;
const LARGEST_MAP: usize = 1_000;
const MOST_FUNCTIONS: usize = 500;
const MOST_VARIABLES: usize = 500;

/// Keywords of Rhai that are words of scripts.
const FREED: [&str; 2] = ["go", "use"];

/// Functions that reach beyond the script, or differ between machines.
const FORBIDDEN: [&str; 2] = ["eval", "**"];

thread_local! {
    /// Operations of the script that this thread asks.
    static SPENT: Cell<u64> = const { Cell::new(0) };
}

/// Returns the number of operations, too.
pub fn counted<T>(ask: impl FnOnce() -> T) -> (T, u64) {
    SPENT.set(0);
    let answer = ask();
    (answer, SPENT.get())
}

/// It holds no script and no home.
pub static ENGINE: LazyLock<Engine> = LazyLock::new(engine);

/// Functions of Rhai that scripts can use, by name.
pub fn standard_functions() -> &'static BTreeSet<String> {
    static NAMES: LazyLock<BTreeSet<String>> = LazyLock::new(|| {
        let signatures = ENGINE.gen_fn_signatures(true);
        let name = |signature: &String| signature.split('(').next().unwrap_or_default().trim().to_owned();
        let is_word = |name: &String| name.starts_with(|c: char| c.is_ascii_lowercase());
        let own: BTreeSet<&str> = vocabulary::words().map(|word| word.name).collect();
        let known = signatures.iter().map(name).filter(|name| is_word(name) && !own.contains(name.as_str()));
        let spoken = known.map(|name| name.trim_start_matches("get ").trim_start_matches("set ").to_owned());
        spoken
            .chain(["type_of", "print", "debug", "call", "curry", "is_def_fn", "is_def_var"].map(String::from))
            .collect()
    });
    &NAMES
}

#[expect(
    deprecated,
    reason = "the hooks for tokens and variables may change with the crate's version, which is locked"
)]
fn engine() -> Engine {
    let mut engine = Engine::new_raw();
    ArithmeticPackage::new().register_into_engine(&mut engine);
    LogicPackage::new().register_into_engine(&mut engine);
    BasicStringPackage::new().register_into_engine(&mut engine);
    MoreStringPackage::new().register_into_engine(&mut engine);
    BasicIteratorPackage::new().register_into_engine(&mut engine);
    BasicFnPackage::new().register_into_engine(&mut engine);
    BasicArrayPackage::new().register_into_engine(&mut engine);
    BasicMapPackage::new().register_into_engine(&mut engine);
    engine
        .set_optimization_level(OptimizationLevel::None)
        .set_max_operations(MOST_OPERATIONS)
        .set_max_call_levels(DEEPEST_CALLS)
        .set_max_expr_depths(DEEPEST_EXPRESSIONS, DEEPEST_EXPRESSIONS)
        .set_max_string_size(LONGEST_TEXT)
        .set_max_array_size(LONGEST_LIST)
        .set_max_map_size(LARGEST_MAP)
        .set_max_functions(MOST_FUNCTIONS)
        .set_max_variables(MOST_VARIABLES)
        .set_fail_on_invalid_map_property(true);
    for symbol in FORBIDDEN {
        engine.disable_symbol(symbol);
    }
    engine.on_print(|_| ()).on_debug(|_, _, _| ());
    engine.on_progress(|operations| {
        SPENT.set(operations);
        None
    });
    engine.on_parse_token(|token, _, _| match token {
        Token::Reserved(word) if FREED.contains(&word.as_str()) => Token::Identifier(word),
        token => token,
    });
    // Functions see the constants of their script.
    engine.on_var(|name, _, context| {
        let is_constant = name.starts_with(|c: char| c.is_ascii_uppercase());
        Ok(is_constant.then(|| around(context.tag()).ok()?.moment().constants.get(name).cloned()).flatten())
    });
    engine.register_type_with_name::<ScriptStep>("step").register_type_with_name::<Around>("around");
    steps_of_places(&mut engine);
    steps_of_time(&mut engine);
    chance(&mut engine);
    numbers(&mut engine);
    seen(&mut engine);
    questions(&mut engine);
    engine
}

fn around(tag: &Dynamic) -> Result<Around, ScriptError> {
    tag.clone().try_cast::<Around>().ok_or_else(|| wrong(ScriptMessage::NotAsked))
}

fn with<T>(
    context: &NativeCallContext,
    act: impl FnOnce(&mut ScriptMoment) -> Result<T, ScriptError>,
) -> Result<T, ScriptError> {
    let tag = context.tag().ok_or_else(|| wrong(ScriptMessage::NotAsked))?;
    act(&mut around(tag)?.moment())
}

type StepResult = Result<ScriptStep, ScriptError>;

fn steps_of_places(engine: &mut Engine) {
    engine
        .register_fn("go", |context: NativeCallContext, place: &str| -> StepResult {
            with(&context, |moment| Ok(ScriptStep::Go(moment.spot(place)?)))
        })
        .register_fn("go_to", |x: Dynamic, y: Dynamic| -> StepResult {
            Ok(ScriptStep::GoTo(Point::new(number(&x, "x")?, number(&y, "y")?)))
        })
        .register_fn("sit", |context: NativeCallContext, seat: &str| -> StepResult {
            with(&context, |moment| moment.seat(seat, Posture::Sitting))
        })
        .register_fn("lie", |context: NativeCallContext, seat: &str| -> StepResult {
            with(&context, |moment| moment.seat(seat, Posture::Lying))
        })
        .register_fn("stand", || ScriptStep::Stand)
        .register_fn("step", |degrees: Dynamic, metres: Dynamic| -> StepResult {
            let (degrees, metres) = (number(&degrees, "the direction")?, number(&metres, "the distance")?);
            if metres <= 0.0 {
                return Err(wrong(ScriptMessage::NegativeStep { distance_m: metres }));
            }
            Ok(ScriptStep::Straight { degrees, metres: metres.min(crate::moment::LOOKS_M) })
        });
    let turn = |on| {
        move |context: NativeCallContext, thing: &str| -> StepResult {
            with(&context, |moment| Ok(ScriptStep::Use { thing: moment.thing(thing)?, on }))
        }
    };
    engine.register_fn("turn_on", turn(true)).register_fn("open", turn(true));
    engine.register_fn("turn_off", turn(false)).register_fn("close", turn(false));
    engine.register_fn("use", |context: NativeCallContext, thing: &str, seconds: Dynamic| -> StepResult {
        let left = span(&seconds)?;
        with(&context, |moment| {
            let (spot, thing) = (moment.spot(thing)?, moment.thing(thing)?);
            let [on, off] = [true, false].map(|on| ScriptStep::Use { thing, on });
            Ok(ScriptStep::All(vec![ScriptStep::Go(spot), on, ScriptStep::wait(left, None), off]))
        })
    });
    engine.register_fn("leave_home", || ScriptStep::LeaveHome).register_fn("come_home", || ScriptStep::ComeHome);
}

fn steps_of_time(engine: &mut Engine) {
    let wander =
        |kind| move |seconds: Dynamic| -> StepResult { Ok(ScriptStep::Wander { kind, left: span(&seconds)? }) };
    engine
        .register_fn("wander", wander(WanderStyle::Random))
        .register_fn("pace", wander(WanderStyle::Pacing))
        .register_fn("lap", wander(WanderStyle::Lapping))
        .register_fn("wait", |seconds: Dynamic| -> StepResult { Ok(ScriptStep::wait(span(&seconds)?, None)) })
        .register_fn("wait", |seconds: Dynamic, name: &str| -> StepResult {
            Ok(ScriptStep::wait(span(&seconds)?, Some(manner(name)?)))
        })
        .register_fn("rest", |seconds: Dynamic| -> StepResult { Ok(ScriptStep::Rest { left: span(&seconds)? }) })
        .register_fn("activity", |label: &str| {
            let label = label.trim();
            ScriptStep::Activity((!label.is_empty()).then(|| label.chars().take(LONGEST_LABEL).collect()))
        })
        .register_fn("instead", |list: Array| -> StepResult {
            let mut steps = vec![ScriptStep::Instead];
            for step in list {
                steps.push(to_step(step)?);
            }
            Ok(ScriptStep::All(steps))
        });
}

/// Largest number of characters of an activity's name (our choice).
const LONGEST_LABEL: usize = 100;

/// A list becomes one step.
pub fn to_step(answer: Dynamic) -> StepResult {
    let of = answer.type_name();
    if let Some(step) = answer.clone().try_cast::<ScriptStep>() {
        return Ok(step);
    }
    if let Ok(list) = answer.into_array() {
        return Ok(ScriptStep::All(list.into_iter().map(to_step).collect::<Result<_, _>>()?));
    }
    Err(wrong(ScriptMessage::NotAStep { found: type_name(of).to_owned() }))
}

fn chance(engine: &mut Engine) {
    engine
        .register_fn("random", |context: NativeCallContext, stream: &str| -> Result<f64, ScriptError> {
            with(&context, |moment| Ok(moment.stream(stream)?.unit()))
        })
        .register_fn(
            "random",
            |context: NativeCallContext, stream: &str, least: Dynamic, most: Dynamic| -> Result<f64, ScriptError> {
                let (least, most) = (number(&least, "the lower limit")?, number(&most, "the upper limit")?);
                with(&context, |moment| Ok(moment.stream(stream)?.between(least, most)))
            },
        )
        .register_fn(
            "chance",
            |context: NativeCallContext, stream: &str, probability: Dynamic| -> Result<bool, ScriptError> {
                let probability = number(&probability, "the probability")?;
                with(&context, |moment| Ok(moment.stream(stream)?.chance(probability)))
            },
        )
        .register_fn("pick", |context: NativeCallContext, stream: &str, list: Array| -> Result<Dynamic, ScriptError> {
            if list.is_empty() {
                return Err(wrong(ScriptMessage::EmptyList));
            }
            let index = with(&context, |moment| Ok(moment.stream(stream)?.pick(&vec![1.0; list.len()])))?;
            Ok(list[index].clone())
        });
}

/// With libm, whose sines are equal on all machines.
fn numbers(engine: &mut Engine) {
    let of = |function: fn(f64) -> f64| {
        move |value: Dynamic| -> Result<f64, ScriptError> { Ok(function(number(&value, "the value")?)) }
    };
    let whole = |function: fn(f64) -> f64| {
        move |value: Dynamic| -> Result<i64, ScriptError> { Ok(function(number(&value, "the value")?) as i64) }
    };
    engine
        .register_fn("sin", of(|degrees| libm::sin(degrees.to_radians())))
        .register_fn("cos", of(|degrees| libm::cos(degrees.to_radians())))
        .register_fn("sqrt", of(|number| libm::sqrt(number.max(0.0))))
        .register_fn("to_float", of(|number| number))
        .register_fn("round", whole(libm::round))
        .register_fn("floor", whole(libm::floor))
        .register_fn("ceiling", whole(libm::ceil))
        .register_fn("to_int", whole(libm::trunc));
}

fn seen(engine: &mut Engine) {
    engine
        .register_get("now", |around: &mut Around| around.moment().now_s())
        .register_get("hour", |around: &mut Around| around.moment().hour())
        .register_get("day", |around: &mut Around| around.moment().day())
        .register_get("weekday", |around: &mut Around| around.moment().weekday().to_owned())
        .register_get("name", |around: &mut Around| around.moment().cast.name.clone())
        .register_get("room", |around: &mut Around| around.moment().room())
        .register_get("place", |around: &mut Around| around.moment().place.clone())
        .register_get("posture", |around: &mut Around| around.moment().posture().to_owned())
        .register_get("x", |around: &mut Around| around.moment().at().x)
        .register_get("y", |around: &mut Around| around.moment().at().y)
        .register_get("dark", |around: &mut Around| around.moment().is_dark())
        .register_get("others", |around: &mut Around| around.moment().others());
}

fn questions(engine: &mut Engine) {
    engine
        .register_fn("is_on", |around: &mut Around, thing: &str| around.moment().is_on(thing))
        .register_fn("is_open", |around: &mut Around, thing: &str| around.moment().is_on(thing))
        .register_fn("is_light", |around: &mut Around, room: &str| around.moment().is_light(room))
        .register_fn("who", |around: &mut Around, room: &str| around.moment().who(room))
        .register_fn("distance", |around: &mut Around, place: &str| around.moment().distance(place))
        .register_fn("can_reach", |around: &mut Around, place: &str| around.moment().can_reach(place))
        .register_fn("toward", |around: &mut Around, place: &str| around.moment().toward(place))
        .register_fn("free", |around: &mut Around, degrees: Dynamic| -> Result<f64, ScriptError> {
            let degrees = number(&degrees, "the direction")?;
            Ok(around.moment().free(degrees))
        });
}

/// The signatures of all words, as the engine registers them.
pub fn known_words() -> Vec<String> {
    ENGINE.gen_fn_signatures(false)
}
